#include "materials/memory_material.hpp"

namespace titin {
namespace {

bool is_plain(const WeightedTerm& term) { return term.wrappers.empty(); }

SumMaterial::Parts only(const SumMaterial::Parts& parts, bool plain) {
  SumMaterial::Parts some = parts;
  std::erase_if(some.terms, [&](const WeightedTerm& term) { return is_plain(term) != plain; });
  return some;
}

std::shared_ptr<const Response> wrap(const SumMaterial::Parts& parts, const WeightedTerm& term) {
  SumMaterial::Parts alone = parts;
  alone.terms = {term};
  alone.terms.front().weight = 1;
  std::shared_ptr<const Response> response =
      std::make_shared<ElasticResponse>(std::make_shared<SumMaterial>(std::move(alone)));
  for (const Wrapper& wrapper : term.wrappers) response = wrapper(response);
  return response;
}

}  // namespace

std::shared_ptr<const Material> with_memory(SumMaterial::Parts parts) {
  if (std::all_of(parts.terms.begin(), parts.terms.end(), is_plain))
    return std::make_shared<SumMaterial>(std::move(parts));
  return std::make_shared<MemoryMaterial>(std::move(parts));
}

void ElasticResponse::evaluate(const PointInput& in, HistoryRows, Mat3* P, Mat9* A, double* W) const {
  material_->stress(in, P, A);
  material_->term_energy(0, in, W);
}

MemoryMaterial::MemoryMaterial(SumMaterial::Parts parts)
    : elastic_(parts), plain_(only(parts, true)), fibres_(parts.fibres) {
  infos_ = plain_.terms();
  for (const WeightedTerm& term : parts.terms) {
    if (is_plain(term)) continue;
    infos_.push_back(term.info);
    infos_.back().dissipates = true;
    remembering_.push_back({wrap(parts, term), term.weight, history_size_});
    history_size_ += remembering_.back().response->history_size();
  }
}

struct MemoryMaterial::Rows {
  Rows(const MemoryMaterial& material, const PointInput& in) : points(in), stride(material.history_size_) {
    points.fibre = directions(in.fibre, material.fibres_.first, own[0]);
    points.second_fibre = directions(in.second_fibre, material.fibres_.second, own[1]);
    if (!in.new_history) scratch.resize(in.n * stride);
    old = in.history;
    now = in.new_history ? in.new_history : scratch.data();
    if (old) return;
    at_rest.resize(in.n * stride);
    for (int p = 0; p < in.n; ++p) {
      PointInput rest;
      rest.n = 1;
      rest.F = rest.F_old = &identity;
      rest.fibre = points.fibre + p;
      rest.second_fibre = points.second_fibre + p;
      rest.fields = in.fields ? in.fields + p * material.fields().numbers.size() : nullptr;
      material.start_history(rest, &at_rest[p * stride]);
    }
    old = at_rest.data();
  }
  HistoryRows of(const Remembering& term) const { return {old + term.at, now + term.at, stride}; }

  PointInput points;
  int stride;
  const double* old;
  double* now;
  std::vector<double> scratch, at_rest;

 private:
  const Vec3* directions(const Vec3* given, const Vec3& materials, std::vector<Vec3>& list) const {
    if (given) return given;
    list.assign(points.n, materials);
    return list.data();
  }
  std::vector<Vec3> own[2];
};

const MemoryMaterial::Remembering* MemoryMaterial::remembering(int term) const {
  const int plain = static_cast<int>(plain_.terms().size());
  return term < plain ? nullptr : &remembering_[term - plain];
}

void MemoryMaterial::stress(const PointInput& in, Mat3* P, Mat9* A) const {
  plain_.stress(in, P, A);
  const Rows rows(*this, in);
  std::vector<Mat3> P_term(in.n);
  std::vector<Mat9> A_term(A ? in.n : 0);
  std::vector<double> W(in.n);
  for (const Remembering& term : remembering_) {
    term.response->evaluate(rows.points, rows.of(term), P_term.data(), A ? A_term.data() : nullptr, W.data());
    for (int p = 0; p < in.n; ++p) {
      for (int i = 0; i < 9; ++i) P[p][i] += term.weight * P_term[p][i];
      for (int i = 0; i < 81 && A; ++i) A[p][i] += term.weight * A_term[p][i];
    }
  }
}

void MemoryMaterial::term_stress(int term, const PointInput& in, Mat3* P) const {
  const Remembering* memory = remembering(term);
  if (!memory) return plain_.term_stress(term, in, P);
  const Rows rows(*this, in);
  std::vector<double> W(in.n);
  memory->response->evaluate(rows.points, rows.of(*memory), P, nullptr, W.data());
  for (int p = 0; p < in.n; ++p)
    for (double& stress : P[p]) stress *= memory->weight;
}

void MemoryMaterial::term_energy(int term, const PointInput& in, double* W) const {
  const Remembering* memory = remembering(term);
  if (!memory) return plain_.term_energy(term, in, W);
  const Rows rows(*this, in);
  std::vector<Mat3> P(in.n);
  memory->response->evaluate(rows.points, rows.of(*memory), P.data(), nullptr, W);
  for (int p = 0; p < in.n; ++p) W[p] *= memory->weight;
}

void MemoryMaterial::potential(const PointInput& in, double* W) const {
  plain_.potential(in, W);
  std::vector<double> stored(in.n);
  for (std::size_t t = plain_.terms().size(); t < infos_.size(); ++t) {
    term_energy(static_cast<int>(t), in, stored.data());
    for (int p = 0; p < in.n; ++p) W[p] += stored[p];
  }
}

void MemoryMaterial::start_history(const PointInput& rest, double* row) const {
  for (const Remembering& term : remembering_) term.response->start(rest, row + term.at);
}

void MemoryMaterial::term_dissipation(int term, int n, const double* history, double* D) const {
  const Remembering* memory = remembering(term);
  for (int p = 0; p < n; ++p)
    D[p] = memory ? memory->weight * memory->response->dissipated(history + p * history_size_ + memory->at) : 0.0;
}

}  // namespace titin
