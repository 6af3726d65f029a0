/// How a scene describes a material: [materials.NAME].
#include "materials/material.hpp"

#include <algorithm>

#include "materials/growth.hpp"
#include "materials/material_advice.hpp"
#include "materials/memory_material.hpp"
#include "materials/spatial_field.hpp"
#include "materials/sum_material.hpp"

namespace titin {
namespace {

template <class Entry>
std::vector<std::string> names(const std::vector<Entry>& entries) {
  std::vector<std::string> list;
  for (const Entry& e : entries) list.push_back(e.info.name);
  return list;
}

/// The entry that `law = "..."` names; null after an error and when keys are listed.
template <class Entry>
const Entry* choose_law(Section& s, const std::vector<Entry>& entries, const char* preferred, const char* doc) {
  const std::vector<std::string> words = names(entries);
  int chosen = -1;
  if (preferred) chosen = static_cast<int>(std::find(words.begin(), words.end(), preferred) - words.begin());
  s.choose_word("law", chosen, words, {.required = preferred == nullptr, .doc = doc});
  return chosen < 0 || s.describing() ? nullptr : &entries[chosen];
}

TermOptions read_options(Section& s, const LawEntry* entry, SumMaterial::Parts& parts) {
  TermOptions options{parts.measure, FibreFamily::first, &parts.fields};
  if (s.describing() || (entry && entry->either_family))
    s.choose("family", options.family, {{"first", FibreFamily::first}, {"second", FibreFamily::second}},
             {.doc = "fibre laws: along `fibre` or along `second_fibre`"});
  return options;
}

bool read_term(const std::string& name, Section s, double weight, SumMaterial::Parts& parts) {
  const LawEntry* entry = choose_law(s, law_entries(), nullptr, "see `titin materials` for the laws and their keys");
  const TermOptions options = read_options(s, entry, parts);
  if (s.describing()) read_wrappers(s, nullptr, options);
  if (!entry) return false;
  const auto same = [&](const WeightedTerm& t) { return t.info.name == name; };
  if (std::any_of(parts.terms.begin(), parts.terms.end(), same))
    s.error("", "this material has another term called \"" + name + "\"",
            "terms of a material and of its mix share names: choose another");
  std::shared_ptr<const Term> term = entry->read(s, options);
  std::vector<Wrapper> wrappers = read_wrappers(s, term.get(), options);
  const bool remembers = !wrappers.empty(), varies = term->has_curves() || (term->has_fields() && s.has("maxwell"));
  if (remembers && varies)
    s.error("", "a law whose numbers vary cannot remember", "give it constants, or drop what is wrapped around it");
  TermInfo info{name, entry->info.name, entry->info.stores_energy};
  info.has_curves = term->has_curves();
  parts.terms.push_back({std::move(info), weight, std::move(term), std::move(wrappers)});
  return !entry->info.needs_volumetric;
}

/// True when a term resists changes of volume itself.
bool read_terms(Section& s, double weight, SumMaterial::Parts& parts) {
  int terms = 0;
  bool resists = false;
  s.each("terms", "what adds up to the material's energy; the names are yours",
         [&](const std::string& name, Section term) {
           ++terms;
           resists |= read_term(name, term, weight, parts);
         });
  if (terms == 0) s.error("", "no terms, no strength", "add [" + s.path() + ".terms] with at least one law");
  return resists;
}

/// Laws in J have their own resistance to changes of volume; the others need a volumetric function.
void read_volumetric(Section& s, double weight, bool needed, SumMaterial::Parts& parts) {
  if (!s.has("volumetric") && !s.describing()) {
    if (needed) s.error("", "no volumetric law", "add volumetric = { law = \"simo\", bulk_modulus = \"10 MPa\" }");
    return;
  }
  Section v = s.section("volumetric", "energy of a change of volume; laws that do not split it off take none");
  if (const VolumetricEntry* entry = choose_law(v, volumetric_entries(), "simo", "volumetric function"))
    parts.volumetric.push_back({weight, entry->read(v)});
}

/// Density, terms and volumetric function: what a material and its mix both have.
void read_constituent(Section s, double weight, SumMaterial::Parts& parts) {
  double density = 0;
  s.read("density", density, {.unit = "kg/m^3", .range = positive, .required = true, .doc = "reference density"});
  parts.density += weight * density;
  const bool resists = read_terms(s, weight, parts);
  const auto stores = [](const WeightedTerm& t) { return t.info.stores_energy; };
  const bool solid = std::any_of(parts.terms.begin(), parts.terms.end(), stores);  // active terms alone: at a point
  read_volumetric(s, weight, solid && !resists, parts);
}

void read_constant_direction(Section& s, const char* key, const char* doc, Vec3& direction) {
  const bool given = s.has(key);
  if (given) direction = {1, 0, 0};  // stays if what is given cannot be read, which is reported there
  s.read(key, direction, {.doc = doc});
  const double length = norm(direction);
  if (given && !(length > 0)) s.error(key, "a fibre of zero length has no direction", "give one such as [1, 0, 0]");
  if (length > 0) direction = {direction[0] / length, direction[1] / length, direction[2] / length};
}

struct Fibres {
  const char *key, *doc;
  bool (Term::*needed)() const;
};

void read_direction(Section& s, const Fibres& fibres, Vec3& direction, MaterialFields::Pointer& field,
                    const SumMaterial::Parts& parts) {
  if (s.is_table(fibres.key) || s.describing()) field = SpatialField::read_directions(s.section(fibres.key));
  if (s.is_table(fibres.key))
    direction = field ? field->first_direction() : Vec3{1, 0, 0};
  else
    read_constant_direction(s, fibres.key, fibres.doc, direction);
  for (const WeightedTerm& t : parts.terms)
    if (!s.has(fibres.key) && (t.term.get()->*fibres.needed)())
      return s.error("", "term \"" + t.info.name + "\" (" + t.info.law + ") needs fibres",
                     std::string("add ") + fibres.key + " = [1, 0, 0], say");
}

void read_fibres(Section& s, SumMaterial::Parts& parts) {
  read_direction(
      s, {"fibre", "direction of the fibres in the reference configuration; any length but zero", &Term::needs_fibre},
      parts.fibres.first, parts.fields.fibre, parts);
  read_direction(s, {"second_fibre", "direction of a second family of fibres, or of sheets", &Term::needs_second_fibre},
                 parts.fibres.second, parts.fields.second_fibre, parts);
  constexpr double perpendicular = 1e-3;  // cosine: directions are given to three digits or more
  const bool same_everywhere = !parts.fields.fibre && !parts.fields.second_fibre;
  for (const WeightedTerm& t : parts.terms) {
    if (!t.term->needs_perpendicular_fibres()) continue;
    parts.fields.at_right_angles = true;
    if (same_everywhere && std::abs(dot(parts.fibres.first, parts.fibres.second)) > perpendicular)
      s.error("second_fibre", "is not at a right angle to the fibre, as term \"" + t.info.name + "\" needs",
              "give directions of orthotropy, [1, 0, 0] and [0, 1, 0], say");
  }
}

void read_measure(Section& s, SumMaterial::Parts& parts) {
  s.choose("fibre_invariants", parts.measure, {{"isochoric", FibreMeasure::isochoric}, {"full", FibreMeasure::full}},
           {.doc = "stretch of fibres without the change of volume, or with it"});
}

double read_mix_fraction(Section mix) {
  double share = 0;
  mix.read("fraction", share,
           {.range = fraction,
            .required = true,
            .doc = "share of the mixed-in constituent: W = (1 - fraction) W + fraction W_mix"});
  return share;
}

}  // namespace

std::shared_ptr<const Material> Material::read(Section s) {
  SumMaterial::Parts parts;
  read_measure(s, parts);
  const bool mixed = s.has("mix") || s.describing();
  double share = 0;
  if (mixed) {
    Section mix = s.section("mix", "second constituent, by the rule of mixtures");
    share = read_mix_fraction(mix);
  }
  read_constituent(s, 1 - share, parts);
  if (mixed) read_constituent(s.section("mix"), share, parts);
  read_fibres(s, parts);
  auto material = read_growth(s, with_memory(std::move(parts)));
  if (!s.describing()) advise(s, *material);
  return material;
}

}  // namespace titin
