#include "materials/variation.hpp"

#include "materials/material.hpp"
#include "materials/spatial_field.hpp"

namespace titin {

void Variations::read(Section& section, std::string_view name, double& value, const Key& key) {
  const char* place = reinterpret_cast<const char*>(&value);
  if (!(place >= begin_ && place + sizeof value <= begin_ + size_)) {
    section.error(name, "this number cannot vary", "give a constant");
    section.section(name);
    return;
  }
  Variation variation;
  variation.at = static_cast<std::size_t>(place - begin_);
  Section table = section.section(name);
  if (!table.has("field")) {
    Table curve(value);
    section.read(name, curve, key);
    value = curve(0);
    variation.curve = std::move(curve);
    list_.push_back(std::move(variation));
    return;
  }
  auto field = SpatialField::read_number(table, key);
  if (!fields_) return section.error(name, "a point is nowhere: no field can be read", "give a number");
  if (!field) return;
  value = field->first();
  variation.field = static_cast<int>(fields_->numbers.size());
  fields_->numbers.push_back(std::move(field));
  list_.push_back(std::move(variation));
}

}  // namespace titin
