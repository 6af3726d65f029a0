#include "io/vtkhdf.hpp"

#include <functional>
#include <stdexcept>

#include "base/parallel.hpp"
#include "io/output_error.hpp"
#include "io/parallel_hdf5.hpp"

namespace titin {
namespace {

constexpr int level = 1;  // of zlib
const std::string root = "VTKHDF";

/// As every such file begins.
void begin(ParallelHdf5& file, std::int64_t version) {
  file.make_group(root);
  file.set_text(root, "Type", "UnstructuredGrid");
  file.set_numbers(root, "Version", {version, 0});
  for (const char* group : {"/PointData", "/CellData", "/FieldData"}) file.make_group(root + group);
}

Slab one_of_each() { return {static_cast<std::uint64_t>(rank()), 1, static_cast<std::uint64_t>(ranks())}; }
Slab on_root(std::uint64_t count) { return {0, is_root() ? count : 0, count}; }

void write_topology(ParallelHdf5& file, const DrawnMesh& mesh) {
  const auto count = [&](const char* name, std::size_t n) {
    const auto number = static_cast<std::int64_t>(n);
    file.write(root + name, one_of_each(), 0, &number);
  };
  count("/NumberOfPoints", mesh.points());
  count("/NumberOfCells", mesh.cells());
  count("/NumberOfConnectivityIds", mesh.connectivity().size());
  std::vector<std::int64_t> offsets(1, 0);
  offsets.insert(offsets.end(), mesh.offsets().begin(), mesh.offsets().end());
  file.write(root + "/Connectivity", Slab::of(mesh.connectivity().size()), 0, mesh.connectivity().data(), level);
  file.write(root + "/Offsets", Slab::of(offsets.size()), 0, offsets.data(), level);
  file.write(root + "/Types", Slab::of(mesh.cells()), 0, mesh.types().data(), level);
}

/// Numbers into a file, in the precision asked for.
class Numbers {
 public:
  Numbers(ParallelHdf5& file, Digits precision, bool grows) : file_(file), precision_(precision), grows_(grows) {}
  void put(const std::string& name, int components, const std::vector<double>& values) {
    if (precision_ == Digits::twofold) return put_as(name, components, values);
    put_as(name, components, std::vector<float>(values.begin(), values.end()));
  }
  void put_all(const std::string& group, const std::vector<DrawnArray>& arrays) {
    for (const DrawnArray& a : arrays) {
      const std::string name = root + group + "/" + a.name;
      const bool is_new = !grows_ || !file_.has(name);
      put(name, a.components == 1 ? 0 : a.components, a.values);
      if (is_new && !a.unit.empty()) file_.set_text(name, "units", a.unit);
    }
  }

 private:
  template <class T>
  void put_as(const std::string& name, int width, const std::vector<T>& values) {
    const Slab slab = Slab::of(values.size() / (width > 0 ? width : 1));
    grows_ ? file_.append(name, slab, width, values.data(), level)
           : file_.write(name, slab, width, values.data(), level);
  }
  ParallelHdf5& file_;
  Digits precision_;
  bool grows_;
};

void guarded(const std::string& path, const std::function<bool()>& act) {
  bool good = false;
  try {
    good = act();
  } catch (const std::runtime_error&) {  // on all ranks
  }
  if (!good) throw OutputError(path);
}

}  // namespace

void write_vtkhdf(const std::string& path, DrawnMesh& mesh, double time, Digits precision) {
  guarded(path, [&] {
    ParallelHdf5 file(path, ParallelHdf5::Mode::create);
    begin(file, 1);
    write_topology(file, mesh);
    Numbers numbers(file, precision, false);
    numbers.put(root + "/Points", 3, mesh.positions());
    numbers.put_all("/PointData", mesh.at_points());
    numbers.put_all("/CellData", mesh.at_cells());
    file.write(root + "/FieldData/time", on_root(1), 0, &time);
    return file.close();
  });
}

TransientVtkhdf::TransientVtkhdf(const std::string& path, Digits precision, long steps)
    : path_(path), precision_(precision), steps_(steps) {
  if (steps == 0) return;
  guarded(path, [&] {
    ParallelHdf5 file(path, ParallelHdf5::Mode::change);
    const std::uint64_t now = file.rows(root + "/Steps/Values");
    const auto keep = [&](const std::string& name) {
      if (now > 0) file.cut_off(name, file.rows(name) / now * steps);
    };
    keep(root + "/Points");
    for (const char* group : {"/PointData", "/CellData", "/Steps/PointDataOffsets", "/Steps/CellDataOffsets", "/Steps"})
      for (const std::string& name : file.names_in(root + group))
        if (const std::string set = root + group + "/" + name; file.has(set)) keep(set);  // else a group
    file.set_numbers(root + "/Steps", "NSteps", {steps});
    return file.close();
  });
}

void TransientVtkhdf::append(DrawnMesh& mesh, double time) {
  guarded(path_, [&] {
    const bool is_new = steps_ == 0;
    ParallelHdf5 file(path_, is_new ? ParallelHdf5::Mode::create : ParallelHdf5::Mode::change);
    if (is_new) {
      begin(file, 2);
      for (const char* group : {"/Steps", "/Steps/PointDataOffsets", "/Steps/CellDataOffsets"})
        file.make_group(root + group);
      write_topology(file, mesh);
    }
    const auto points = static_cast<std::int64_t>(Slab::of(mesh.points()).total) * steps_;
    const auto cells = static_cast<std::int64_t>(Slab::of(mesh.cells()).total) * steps_;
    const std::int64_t none = 0, parts = ranks();
    const std::string steps = root + "/Steps/";
    file.append(steps + "Values", on_root(1), 0, &time);
    file.append(steps + "PartOffsets", on_root(1), 0, &none);  // the topology stays as it is
    file.append(steps + "NumberOfParts", on_root(1), 0, &parts);
    file.append(steps + "PointOffsets", on_root(1), 0, &points);
    file.append(steps + "CellOffsets", on_root(1), 1, &none);
    file.append(steps + "ConnectivityIdOffsets", on_root(1), 1, &none);
    Numbers numbers(file, precision_, true);
    numbers.put(root + "/Points", 3, mesh.positions());
    const std::vector<DrawnArray> at_points = mesh.at_points(), at_cells = mesh.at_cells();
    numbers.put_all("/PointData", at_points);
    numbers.put_all("/CellData", at_cells);
    for (const DrawnArray& a : at_points) file.append(steps + "PointDataOffsets/" + a.name, on_root(1), 0, &points);
    for (const DrawnArray& a : at_cells) file.append(steps + "CellDataOffsets/" + a.name, on_root(1), 0, &cells);
    file.set_numbers(root + "/Steps", "NSteps", {++steps_});
    return file.close();
  });
}

}  // namespace titin
