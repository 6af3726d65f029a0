#include "io/paraview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "base/parallel.hpp"
#include "io/output_error.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

/// As a whole: a reader sees the old or the new text.
void replace(const std::string& path, const std::string& text) {
  const std::string part = path + ".part";
  std::error_code error;
  const bool written = static_cast<bool>(std::ofstream(part, std::ios::binary) << text << std::flush);
  if (written) fs::rename(part, path, error);
  if (!written || error) throw OutputError(path);
}

void make_folder(const std::string& path) {
  std::error_code error;
  if (is_root()) fs::create_directories(path, error);
  any_of(false);  // waits for it
  if (any_of(!fs::is_directory(path))) throw OutputError(path);
}

std::string cycle_folder(int cycle) { return fmt::format("Cycle{:06}", cycle); }
std::string piece_name(int rank) { return fmt::format("proc{:06}.vtu", rank); }

}  // namespace

ParaView::ParaView(const std::string& run, mfem::ParMesh& mesh, const std::vector<Field>& fields,
                   const FieldFiles& files, std::vector<Entry> earlier)
    : folder_(run + "/fields"), files_(files), mesh_(mesh, fields, files.jumps), entries_(std::move(earlier)) {
  make_folder(folder_);
  if (!entries_.empty()) remove_later();
  if (files.format == FieldFormat::vtkhdf_transient)
    transient_ = std::make_unique<TransientVtkhdf>(folder_ + "/fields.vtkhdf", files.precision,
                                                   static_cast<long>(entries_.size()));
  if (!entries_.empty()) write_index();
}

void ParaView::write(int cycle, double time) {
  if (files_.format == FieldFormat::vtu)
    write_pieces(cycle);
  else if (transient_)
    transient_->append(mesh_, time);
  else
    write_vtkhdf(folder_ + "/" + name_of(cycle), mesh_, time, files_.precision);
  entries_.push_back({cycle, time});
  write_index();
}

std::string ParaView::name_of(int cycle) const {
  return files_.format == FieldFormat::vtu ? cycle_folder(cycle) + "/data.pvtu"
                                           : fmt::format("fields_{:06}.vtkhdf", cycle);
}

void ParaView::write_pieces(int cycle) {
  const std::string folder = folder_ + "/" + cycle_folder(cycle);
  make_folder(folder);
  const std::vector<DrawnArray> points = mesh_.at_points(), cells = mesh_.at_cells();
  bool good = true;
  try {
    write_vtu(folder + "/" + piece_name(rank()), mesh_, mesh_.positions(), points, cells, files_.precision);
  } catch (const OutputError&) {
    good = false;
  }
  if (any_of(!good)) throw OutputError(folder);
  if (!is_root()) return;
  std::vector<std::string> pieces;
  for (int r = 0; r < ranks(); ++r) pieces.push_back(piece_name(r));
  replace(folder + "/data.pvtu", pvtu_text(pieces, points, cells, files_.precision));
}

/// Times with all their digits: 17 tell any two apart.
void ParaView::write_index() const {
  if (!is_root() || transient_) return;
  std::string text;
  if (files_.format == FieldFormat::vtu) {
    text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"2.2\" "
        "byte_order=\"LittleEndian\">\n<Collection>\n";
    for (const Entry& e : entries_)
      text += fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", e.time, name_of(e.cycle));
    replace(folder_ + "/fields.pvd", text + "</Collection>\n</VTKFile>\n");
    return;
  }
  for (const Entry& e : entries_)
    text +=
        fmt::format("{}\n    {{ \"name\": \"{}\", \"time\": {} }}", text.empty() ? "" : ",", name_of(e.cycle), e.time);
  replace(folder_ + "/fields.vtkhdf.series",
          fmt::format("{{\n  \"file-series-version\": \"1.0\",\n  \"files\": [{}\n  ]\n}}\n", text));
}

/// Data of cycles that are not among the entries.
void ParaView::remove_later() const {
  std::set<std::string> known;
  for (const Entry& e : entries_) {
    known.insert(cycle_folder(e.cycle));
    known.insert(fmt::format("fields_{:06}.vtkhdf", e.cycle));
  }
  std::error_code error;
  std::vector<fs::path> later;
  if (is_root())
    for (const auto& entry : fs::directory_iterator(folder_, error)) {
      const std::string name = entry.path().filename().string();
      const bool ours = name.starts_with("Cycle") || (name.starts_with("fields_") && name.ends_with(".vtkhdf"));
      if (ours && !entry.is_symlink() && !known.count(name)) later.push_back(entry.path());
    }
  for (const fs::path& path : later)
    if (fs::is_directory(path)) {
      for (int r = 0; fs::remove(path / piece_name(r), error); ++r) continue;
      fs::remove(path / "data.pvtu", error);
      fs::remove(path, error);  // unless the user has put something there
    } else {
      fs::remove(path, error);
    }
  any_of(false);
}

}  // namespace titin
