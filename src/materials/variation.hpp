/// Numbers of a law that vary: curves in time and fields in space.
///
/// A law stays a plain struct of constants. What varies is kept beside it, as the place of a number in the struct and
/// where its value comes from; before the law is evaluated those numbers are set, once for all points where only time
/// matters, and point by point where space does. Stress, tangent and energies all see the same numbers.
#pragma once

#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "base/config.hpp"

namespace titin {

struct MaterialFields;

struct Variation {
  std::size_t at = 0;  ///< bytes from the start of the law
  Table curve;         ///< in time, SI; looked at when there is no field
  int field = -1;      ///< index in MaterialFields::numbers
};

/// Collects what of a law varies while it is bound.
class Variations final : public VaryingNumbers {
 public:
  /// `law` is being bound; fields are added to `fields`, null where there is no space to vary in.
  Variations(const void* law, std::size_t size, MaterialFields* fields)
      : begin_(static_cast<const char*>(law)), size_(size), fields_(fields) {}
  void read(Section& section, std::string_view name, double& value, const Key& key) override;
  const std::vector<Variation>& list() const { return list_; }

 private:
  const char* begin_;
  std::size_t size_;
  MaterialFields* fields_;
  std::vector<Variation> list_;
};

/// A law and what of it varies. Not for several threads at once: it has one copy of the law to set numbers in.
template <class Law>
class VariedLaw {
 public:
  explicit VariedLaw(Law law, std::vector<Variation> variations = {})
      : law_(std::move(law)), variations_(std::move(variations)) {
    if (!variations_.empty()) varied_.push_back(law_);
    for (const Variation& v : variations_) (v.field < 0 ? has_curves_ : has_fields_) = true;
  }
  const Law& first() const { return law_; }  ///< as it was bound
  bool has_curves() const { return has_curves_; }
  bool has_fields() const { return has_fields_; }

  /// Calls visit(law, p, end) for runs of points p <= . < end that share their numbers, all points together.
  template <class Block, class Visit>
  void visit(const Block& points, Visit visit) const {
    if (variations_.empty()) return visit(law_, 0, points.n);
    for (const Variation& v : variations_)
      if (v.field < 0) set(v, v.curve(points.time));
    if (!has_fields_) return visit(varied_.front(), 0, points.n);
    for (int p = 0; p < points.n; ++p) {
      for (const Variation& v : variations_)
        if (v.field >= 0) set(v, points.fields ? points.fields[p * points.field_count + v.field] : unknown);
      visit(varied_.front(), p, p + 1);
    }
  }

  double activation(double time) const {
    if constexpr (requires { law_.activation(time); })
      return law_.activation(time);
    else
      return 0;
  }

 private:
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();  // nobody said where the point is

  void set(const Variation& v, double value) const {
    std::memcpy(reinterpret_cast<char*>(&varied_.front()) + v.at, &value, sizeof value);
  }

  Law law_;
  std::vector<Variation> variations_;
  mutable std::vector<Law> varied_;  // one, where something varies
  bool has_curves_ = false, has_fields_ = false;
};

}  // namespace titin
