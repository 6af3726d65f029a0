/// The fields that a model keeps for ParaView, made once and filled anew at every update.
#pragma once

#include <memory>

#include "solve/model.hpp"

namespace titin {

class FieldList {
 public:
  /// A field of zeros on the caller's space, which must live as long as this.
  mfem::ParGridFunction* add(const std::string& name, const std::string& unit, mfem::ParFiniteElementSpace& space) {
    storage_.push_back(std::make_unique<mfem::ParGridFunction>(&space));
    *storage_.back() = 0.0;
    fields_.push_back({name, unit, storage_.back().get()});
    return storage_.back().get();
  }
  const std::vector<Field>& fields() const { return fields_; }

 private:
  std::vector<std::unique_ptr<mfem::ParGridFunction>> storage_;
  std::vector<Field> fields_;
};

}  // namespace titin
