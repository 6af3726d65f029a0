#include "io/vtu.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <cstring>
#include <fstream>

#include "io/output_error.hpp"

namespace titin {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

constexpr std::size_t block = 1u << 18;  // bytes that are compressed at a time: VTK reads them one by one
constexpr int level = 1;                 // of zlib: more takes several times as long for some percent

/// VTK's layout of compressed data: numbers of blocks and bytes as UInt64, then the blocks.
std::string compressed(const char* bytes, std::size_t size) {
  const std::size_t blocks = (size + block - 1) / block, rest = size % block;
  std::vector<std::uint64_t> head = {blocks, block, rest};
  std::string body;
  std::vector<Bytef> packed(compressBound(block));
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t length = b + 1 < blocks || rest == 0 ? block : rest;
    uLongf packed_size = packed.size();
    compress2(packed.data(), &packed_size, reinterpret_cast<const Bytef*>(bytes + b * block), length, level);
    head.push_back(packed_size);
    body.append(reinterpret_cast<const char*>(packed.data()), packed_size);
  }
  return std::string(reinterpret_cast<const char*>(head.data()), head.size() * sizeof head[0]) + body;
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += c;
  }
  return safe;
}

std::string unit_text(const std::string& unit) {
  if (unit.empty()) return "";
  return fmt::format("<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>",
                     escaped(unit));
}

const char* type_name(Digits precision) { return precision == Digits::single ? "Float32" : "Float64"; }

/// The XML of arrays, and the bytes that it points to.
class Pieces {
 public:
  template <class T>
  void add(const std::string& name, const char* type, int components, const std::vector<T>& values,
           const std::string& unit = "") {
    xml += fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
        "offset=\"{}\">{}</DataArray>\n",
        type, escaped(name), components, data.size(), unit_text(unit));
    data += compressed(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  void add_numbers(const std::string& name, int components, const std::vector<double>& values, Digits precision,
                   const std::string& unit = "") {
    if (precision == Digits::twofold) return add(name, "Float64", components, values, unit);
    add(name, "Float32", components, std::vector<float>(values.begin(), values.end()), unit);
  }
  void add_all(const std::vector<DrawnArray>& arrays, Digits precision) {
    for (const DrawnArray& a : arrays) add_numbers(a.name, a.components, a.values, precision, a.unit);
  }
  std::string xml, data;
};

constexpr const char* opening =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"2.2\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n";

}  // namespace

void write_vtu(const std::string& path, DrawnMesh& mesh, const std::vector<double>& positions,
               const std::vector<DrawnArray>& points, const std::vector<DrawnArray>& cells, Digits precision) {
  Pieces p;
  p.xml = fmt::format(fmt::runtime(opening), "UnstructuredGrid");
  p.xml += fmt::format("<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n",
                       mesh.points(), mesh.cells());
  p.add_numbers("Points", 3, positions, precision);
  p.xml += "</Points>\n<Cells>\n";
  p.add("connectivity", "Int64", 1, mesh.connectivity());
  p.add("offsets", "Int64", 1, mesh.offsets());
  p.add("types", "UInt8", 1, mesh.types());
  p.xml += "</Cells>\n<PointData>\n";
  p.add_all(points, precision);
  p.xml += "</PointData>\n<CellData>\n";
  p.add_all(cells, precision);
  p.xml += "</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  std::ofstream out(path, std::ios::binary);
  out << p.xml << p.data << "\n</AppendedData>\n</VTKFile>\n" << std::flush;
  if (!out) throw OutputError(path);
}

std::string pvtu_text(const std::vector<std::string>& pieces, const std::vector<DrawnArray>& points,
                      const std::vector<DrawnArray>& cells, Digits precision) {
  std::string text = fmt::format(fmt::runtime(opening), "PUnstructuredGrid");
  const auto list = [&](const char* of, const std::vector<DrawnArray>& arrays) {
    text += fmt::format("<{}>\n", of);
    for (const DrawnArray& a : arrays)
      text += fmt::format("<PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", type_name(precision),
                          escaped(a.name), a.components);
    text += fmt::format("</{}>\n", of);
  };
  text += fmt::format(
      "<PUnstructuredGrid GhostLevel=\"0\">\n<PPoints>\n<PDataArray type=\"{}\" Name=\"Points\" "
      "NumberOfComponents=\"3\"/>\n</PPoints>\n",
      type_name(precision));
  list("PPointData", points);
  list("PCellData", cells);
  for (const std::string& piece : pieces) text += fmt::format("<Piece Source=\"{}\"/>\n", escaped(piece));
  return text + "</PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace titin
