/// The list of laws: what `titin materials` prints and where a scene's law names become terms.
///
/// A law registers itself by the last line of its header, TITIN_LAW(Struct); laws.cpp includes every law's header and
/// that is all there is to say (a self-registering object file per law would be lost in a static library).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/log.hpp"
#include "materials/power_term.hpp"
#include "materials/term.hpp"
#include "materials/variation.hpp"

namespace titin {

/// A parameter set that can be traced: the values as a scene would say them, what they were measured on, and where.
struct ParameterSet {
  std::string tissue, parameters, source;
};

/// What a user should know of numbers that are allowed but seldom meant, or that make trouble later on.
struct Advice {
  std::string key, text;  ///< the key that it is about; "" for the law as a whole
};

struct LawInfo {
  std::string name, kind, formula, source;  ///< kind: matrix, fibre, active, volumetric or fluid
  std::vector<KeyRecord> parameters;
  std::vector<ParameterSet> published;
  std::string unpublished;  ///< why there is no published set; "" when there is one
  bool needs_fibre = false, needs_second_fibre = false, stores_energy = true, uses_rate = false, advises = false;
  bool has_potential = true;     ///< stores energy, or would while its activation is held
  bool needs_volumetric = true;  ///< false for laws that resist changes of volume themselves
  std::string pulls_at_rest;     ///< why there is stress without deformation; "" when there is none
};

/// U(ratio) of a volume ratio.
class VolumetricLaw {
 public:
  struct Value {
    double U, dU, d2U;
  };
  virtual ~VolumetricLaw() = default;
  virtual Value evaluate(double ratio) const = 0;
  /// Adds weight times U and dU of n ratios.
  virtual void add(int n, const double* ratio, double weight, double* U, double* dU) const = 0;
};

/// What a material's term knows besides the law's own parameters.
struct TermOptions {
  FibreMeasure measure = FibreMeasure::isochoric;  ///< handed to laws with a member of that name
  FibreFamily family = FibreFamily::first;
  MaterialFields* fields = nullptr;  ///< where parameters that vary in space are listed; null: none may
};

struct LawEntry {
  LawInfo info;
  bool either_family = false;  ///< a law of one family of fibres: may run along the second too
  std::function<std::unique_ptr<Term>(Section, TermOptions)> read;
};
struct VolumetricEntry {
  LawInfo info;
  std::function<std::unique_ptr<VolumetricLaw>(Section)> read;
};

/// All laws and volumetric functions with their parameters, by kind and name.
std::vector<LawInfo> laws();
/// The same as the scene reader wants them.
const std::vector<LawEntry>& law_entries();
const std::vector<VolumetricEntry>& volumetric_entries();

namespace detail {

bool add(LawEntry entry);
bool add(VolumetricEntry entry);

template <class Law>
std::vector<ParameterSet> published() {
  if constexpr (requires { Law::published; })
    return {Law::published.begin(), Law::published.end()};
  else
    return {};
}

template <class Law>
LawInfo info() {
  LawInfo info;
  info.name = Law::name, info.formula = Law::formula, info.source = Law::source;
  info.published = published<Law>();
  if constexpr (requires { Law::unpublished; }) info.unpublished = Law::unpublished;
  info.advises = requires(Law law) { law.advice(); };
  if constexpr (requires { Law::pulls_at_rest; }) info.pulls_at_rest = Law::pulls_at_rest;
  return info;
}

/// Reads a law's keys into it and says what it has to say about them.
template <class Law>
void bind_law(Law& law, Section s) {
  law.bind(s);
  if constexpr (requires { law.advice(); })
    if (!s.describing())
      for (const Advice& a : law.advice())
        logging::warning(fmt::format("{}{}{}: {}", s.path(), a.key.empty() ? "" : ".", a.key, a.text));
}
template <class Law>
Law read_law(Section s) {
  Law law;
  bind_law(law, s);
  return law;
}

template <class Law>
std::unique_ptr<Term> make_term(Law law, TermOptions options, std::vector<Variation> variations = {}) {
  if constexpr (requires { law.measure = options.measure; }) law.measure = options.measure;
  if constexpr (PowerLaw<Law>) {
    return std::make_unique<PowerTerm>(law.powers());
  } else {
    VariedLaw<Law> varied(std::move(law), std::move(variations));
    if constexpr (InvariantLaw<Law>)
      return std::make_unique<EnergyTerm<Law>>(std::move(varied), options.family);
    else if constexpr (ForceLaw<Law>)
      return std::make_unique<ForceTerm<Law>>(std::move(varied), options.family);
    else
      return std::make_unique<FibreTerm<Law>>(std::move(varied), options.family);
  }
}

/// Binds a law, whose numbers may be curves or fields, and makes it a term.
template <class Law>
std::unique_ptr<Term> read_term(Section s, TermOptions options) {
  if constexpr (PowerLaw<Law>) {
    return make_term(read_law<Law>(s), options);
  } else {
    Law law;
    Variations variations(&law, sizeof law, options.fields);
    bind_law(law, s.accepting(variations));
    return make_term(std::move(law), options, variations.list());
  }
}

template <class Law>
bool register_law() {
  LawInfo info = detail::info<Law>();
  const auto term = make_term(Law{}, {});
  const InvariantSet uses = term->uses();
  info.needs_fibre = term->needs_fibre();
  info.needs_second_fibre = term->needs_second_fibre();
  info.stores_energy = term->stores_energy();
  info.uses_rate = uses.has_rate();
  info.has_potential = info.stores_energy || requires(Law law) { law.potential(1.0, 0.0); };
  if constexpr (requires { Law::needs_volumetric; })
    info.needs_volumetric = Law::needs_volumetric;
  else
    info.needs_volumetric = !uses.has(Invariant::J);
  info.kind = !info.stores_energy ? "active" : info.needs_fibre ? "fibre" : "matrix";
  const bool either = uses.has(Invariant::I4) && !uses.has_any({Invariant::I5, Invariant::I6, Invariant::I8});
  return add(LawEntry{std::move(info), either, read_term<Law>});
}

template <class Law>
class VolumetricAdaptor final : public VolumetricLaw {
 public:
  explicit VolumetricAdaptor(Law law) : law_(law) {}
  Value evaluate(double ratio) const override {
    const Dual<1> U = law_.energy(Dual<1>::variable(ratio, 0));
    return {U.value, U.gradient[0], U.hessian[0]};
  }
  void add(int n, const double* ratio, double weight, double* U, double* dU) const override {
    for (int i = 0; i < n; ++i) {
      const auto value = law_.energy(Dual<1, 1>::variable(ratio[i], 0));
      U[i] += weight * value.value;
      dU[i] += weight * value.gradient[0];
    }
  }

 private:
  Law law_;
};

template <class Law>
bool register_volumetric() {
  LawInfo info = detail::info<Law>();
  info.kind = "volumetric";
  return add(VolumetricEntry{std::move(info),
                             [](Section s) { return std::make_unique<VolumetricAdaptor<Law>>(read_law<Law>(s)); }});
}

}  // namespace detail
}  // namespace titin

#define TITIN_LAW(Law) inline const bool registered_##Law = ::titin::detail::register_law<Law>();
#define TITIN_VOLUMETRIC(Law) inline const bool registered_##Law = ::titin::detail::register_volumetric<Law>();
