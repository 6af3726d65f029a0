#include "mesh/gmsh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <vector>

#include "base/words.hpp"

namespace titin {
namespace {

constexpr const char* how_to_save = "save it from Gmsh as \"Version 2 ASCII\" (gmsh -save -format msh22)";
constexpr const char* save_again = "the file is damaged: save it again";
constexpr long most_entries = 1'000'000'000;  // nodes or elements; a larger number is no number of them

enum class Shape { point, edge, triangle, quadrangle, tetrahedron, prism, hexahedron, pyramid };

using Corners = std::vector<int>;
/// What a shape is bounded by: the corners of its sides in Gmsh's numbering.
struct Solid {
  int dimension, corners;
  std::vector<Corners> sides;
};
const Solid& solid(Shape shape) {
  static const Solid all[] = {
      {0, 1, {}},
      {1, 2, {}},
      {2, 3, {{0, 1}, {1, 2}, {2, 0}}},
      {2, 4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
      {3, 4, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}},
      {3, 6, {{0, 1, 2}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
      {3, 8, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
      {3, 5, {}},  // refused
  };
  return all[static_cast<int>(shape)];
}

/// Kinds of elements by their number in the file; of any order they begin with the corners.
struct ElementKind {
  int type, nodes;
  Shape shape;
};
constexpr ElementKind kinds[] = {
    {15, 1, Shape::point},        {1, 2, Shape::edge},         {8, 3, Shape::edge},        {26, 4, Shape::edge},
    {2, 3, Shape::triangle},      {9, 6, Shape::triangle},     {21, 10, Shape::triangle},  {3, 4, Shape::quadrangle},
    {10, 9, Shape::quadrangle},   {36, 16, Shape::quadrangle}, {4, 4, Shape::tetrahedron}, {11, 10, Shape::tetrahedron},
    {29, 20, Shape::tetrahedron}, {6, 6, Shape::prism},        {13, 18, Shape::prism},     {5, 8, Shape::hexahedron},
    {12, 27, Shape::hexahedron},  {92, 64, Shape::hexahedron}, {7, 5, Shape::pyramid},     {14, 14, Shape::pyramid},
};

/// Corners in increasing order, the last repeated.
struct Side {
  std::array<int, 4> corners;
  long line;
};

struct Element {
  Shape shape;
  std::array<int, 8> corners;
  long line;
};

struct Problem {
  std::string text, advice = save_again;
};

class Scan {
 public:
  explicit Scan(std::istream& in) : in_(in) {}

  GmshFile file() {
    try {
      read_format();
      while (next_line())
        if (trim(line_) == "$PhysicalNames")
          read_names();
        else if (trim(line_) == "$Nodes")
          read_nodes();
        else if (trim(line_) == "$Elements")
          read_elements();
      take_cells();
      check_sides();
      if (in_group_ && in_no_group_)
        throw Problem{
            fmt::format("has elements with a physical group (line {}) and without (line {})", in_group_, in_no_group_),
            "give a physical group to all surfaces and volumes that are saved, or to none"};
    } catch (const Problem& problem) {
      file_.problem = problem.text;
      file_.advice = problem.advice;
    }
    return file_;
  }

 private:
  bool next_line() {
    ++number_;
    return static_cast<bool>(std::getline(in_, line_));
  }

  [[noreturn]] void fail(const std::string& text, const std::string& advice = save_again) const {
    throw Problem{fmt::format("line {}: {}", number_, text), advice};
  }

  /// The next line's words.
  const std::vector<std::string_view>& words() {
    if (!next_line()) throw Problem{fmt::format("ends after {}", count(number_ - 1, "line"))};
    constexpr const char* gaps = " \t\r";
    words_.clear();
    for (auto end = std::string::npos, start = line_.find_first_not_of(gaps); start != std::string::npos;
         start = line_.find_first_not_of(gaps, end)) {
      end = std::min(line_.find_first_of(gaps, start), line_.size());
      words_.push_back(std::string_view(line_).substr(start, end - start));
    }
    return words_;
  }

  template <class Number>
  Number number(std::size_t i) const {
    if (i >= words_.size()) fail("has too few numbers");
    Number x{};
    const auto [end, status] = std::from_chars(words_[i].data(), words_[i].data() + words_[i].size(), x);
    if (status != std::errc() || end != words_[i].data() + words_[i].size())
      fail(fmt::format("{} is no such number as belongs here", in_quotes(words_[i])));
    return x;
  }

  long size_of_section() {
    words();
    const long size = number<long>(0);
    if (size < 0 || size > most_entries) fail(fmt::format("{} is no number of entries", size));
    return size;
  }

  void read_format() {
    if (!next_line() || trim(line_) != "$MeshFormat")
      throw Problem{"is not a Gmsh mesh: it does not begin with $MeshFormat", how_to_save};
    if (words().size() != 3 || words_[0].rfind("2.2", 0) != 0)
      throw Problem{fmt::format("is a Gmsh mesh of version {}, and only 2.2 is read",
                                words_.empty() ? "?" : printable(words_[0])),
                    how_to_save};
    if (words_[1] != "0") throw Problem{"is a binary Gmsh mesh, and only text is read", how_to_save};
  }

  void read_names() {
    for (long rest = size_of_section(); rest > 0; --rest) {
      words();
      const int dimension = number<int>(0), tag = number<int>(1);
      const auto first = line_.find('"'), last = line_.rfind('"');
      if (first == std::string::npos || last <= first) fail("has no name in quotation marks");
      const std::string name = line_.substr(first + 1, last - first - 1);
      if (dimension >= 0 && dimension <= 3) names_[dimension][name] = tag;
    }
  }

  void read_nodes() {
    for (long rest = size_of_section(); rest > 0; --rest) {
      words();
      for (int i = 1; i <= 3; ++i)
        if (!std::isfinite(number<double>(i))) fail("has a coordinate that is not finite");
      if (!nodes_.emplace(number<int>(0), static_cast<int>(nodes_.size())).second)
        fail(fmt::format("node {} is there already", words_[0]));
    }
  }

  /// number, type, number of tags, tags, nodes
  void read_elements() {
    for (long rest = size_of_section(); rest > 0; --rest) {
      words();
      const ElementKind& kind = kind_of(number<int>(1));
      const int tags = number<int>(2);
      if (tags < 0 || 3u + tags + kind.nodes != words_.size())
        fail(fmt::format("an element of type {} with {} has {}", kind.type, count(tags, "tag"),
                         count(3.0 + tags + kind.nodes, "number")));
      elements_.push_back({kind.shape, read_corners(3 + tags, solid(kind.shape).corners), number_});
      long& first_line = tags > 0 && number<int>(3) > 0 ? in_group_ : in_no_group_;
      if (first_line == 0) first_line = number_;
    }
  }

  /// Looks at all nodes of an element and returns the first.
  std::array<int, 8> read_corners(std::size_t first, int size) {
    std::array<int, 8> corners{};
    for (std::size_t i = first; i < words_.size(); ++i) {
      const auto node = nodes_.find(number<int>(i));
      if (node == nodes_.end()) fail(fmt::format("there is no node {}", words_[i]));
      if (i < first + size) corners[i - first] = node->second;
    }
    Corners sorted(corners.begin(), corners.begin() + size);
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      fail("an element has a node twice", "use whole elements");
    return corners;
  }

  /// Cells are the elements of the highest dimension, in space or in the plane; boundaries those of one less.
  void take_cells() {
    int dimension = 0;
    for (const Element& element : elements_) dimension = std::max(dimension, solid(element.shape).dimension);
    if (dimension < 2) throw Problem{"holds no cells", "mesh the volume (a plane body: its surface), and save it too"};
    file_.volumes = names_[dimension];
    file_.surfaces = names_[dimension - 1];
    for (const Element& element : elements_) {
      const Solid& shape = solid(element.shape);
      Corners all(shape.corners);
      std::iota(all.begin(), all.end(), 0);
      if (shape.dimension == dimension)
        for (const Corners& side : shape.sides) add_side(cell_sides_, element, side);
      if (shape.dimension == dimension - 1) add_side(surfaces_, element, all);
    }
  }

  static void add_side(std::vector<Side>& sides, const Element& element, const Corners& corners) {
    Corners nodes;
    for (int corner : corners) nodes.push_back(element.corners[corner]);
    std::sort(nodes.begin(), nodes.end());
    Side side{{}, element.line};
    side.corners.fill(nodes.back());
    std::copy(nodes.begin(), nodes.end(), side.corners.begin());
    sides.push_back(side);
  }

  /// Cells share whole sides, and surfaces are sides of cells.
  void check_sides() {
    const auto before = [](const Side& a, const Side& b) { return a.corners < b.corners; };
    std::stable_sort(cell_sides_.begin(), cell_sides_.end(), before);
    for (std::size_t i = 1; i < cell_sides_.size(); ++i) {
      const auto &one = cell_sides_[i - 1], &two = cell_sides_[i];
      if (i > 1 && cell_sides_[i - 2].corners == two.corners)
        throw Problem{fmt::format("line {}: a side belongs to more than two cells", two.line)};
      if (one.corners != two.corners && std::equal(&one.corners[0], &one.corners[3], &two.corners[0]))
        throw Problem{
            fmt::format("lines {} and {}: cells that share three corners of a side, not four", one.line, two.line)};
    }
    for (const Side& surface : surfaces_)
      if (!std::binary_search(cell_sides_.begin(), cell_sides_.end(), surface, before))
        throw Problem{fmt::format("line {}: a surface that is no side of a cell", surface.line)};
  }

  const ElementKind& kind_of(int type) const {
    for (const ElementKind& kind : kinds) {
      if (kind.type != type) continue;
      if (kind.shape == Shape::pyramid)
        throw Problem{fmt::format("has pyramids (line {}), and there is no element for them", number_),
                      "mesh it with hexahedra, wedges or tetrahedra"};
      return kind;
    }
    fail(fmt::format("elements of type {} are not read", type), "use elements of order 1, 2 or 3");
  }

  std::istream& in_;
  std::string line_;
  std::vector<std::string_view> words_;
  long number_ = 0;                                  // of line_
  long in_group_ = 0, in_no_group_ = 0;              // lines of the first elements with and without a physical group
  std::unordered_map<int, int> nodes_;               // number in the file -> place in it
  std::array<std::map<std::string, int>, 4> names_;  // by dimension
  std::vector<Element> elements_;
  std::vector<Side> cell_sides_, surfaces_;
  GmshFile file_;
};

}  // namespace

GmshFile scan_gmsh(std::istream& in) { return Scan(in).file(); }

}  // namespace titin
