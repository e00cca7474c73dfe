#include "modules/io/obj_reader.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "graph/api/error.hpp"
#include "modules/io/faces.hpp"
#include "modules/io/lines.hpp"
#include "modules/io/obj_groups.hpp"

namespace atrium::io {
namespace {

struct Group {
  SurfaceClass surface = SurfaceClass::object;
  std::int32_t primitive = -1;
};

/// What a piece of the file holds; indices into other pieces are resolved when the counts before it are known.
struct Piece {
  std::vector<Eigen::Vector3d> vertices, normals;
  std::vector<std::array<double, 3>> colours;
  struct Corner {
    std::int64_t vertex = 0, normal = 0;  ///< as written, negative ones made absolute within the piece's own counting
    bool relative_vertex = false, relative_normal = false;
  };
  struct Face {
    std::size_t first = 0, corners = 0, line = 0;
    std::optional<Group> group;  ///< set at the first face after a group's line
  };
  std::vector<Corner> corners;
  std::vector<Face> faces;
  std::optional<Group> group;  ///< the last one named in it
  bool named = false;          ///< there is a group whose name tells class and primitive
  std::size_t coloured = 0;    ///< vertices with colour
};

class PieceParser {
 public:
  PieceParser(const std::string& path, Piece& piece) : path_(path), piece_(piece) {}

  void read(const Row& row) {
    row_ = &row;
    std::string_view rest = row.text;
    const std::string_view keyword = next_token(rest);
    if (keyword == "v")
      read_vertex(rest);
    else if (keyword == "vn")
      piece_.normals.push_back(vector(rest));
    else if (keyword == "f")
      read_face(rest);
    else if (keyword == "g" || keyword == "o")
      read_group(rest);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}:{}: {}", path_, row_->line, what));
  }

  double number(std::string_view token) const {
    double v = 0;
    if (token.empty()) fail("the line ends before its third number");
    if (!parse_number(token, v)) fail(quote(token) + " is not a number");
    return v;
  }
  Eigen::Vector3d vector(std::string_view& rest) const {
    Eigen::Vector3d v;
    for (int a = 0; a < 3; ++a) v[a] = number(next_token(rest));
    return v;
  }

  /// x y z, x y z w, x y z r g b, or x y z w r g b.
  void read_vertex(std::string_view rest) {
    piece_.vertices.push_back(vector(rest));
    std::array<double, 4> more{};
    std::size_t n = 0;
    for (auto token = next_token(rest); !token.empty(); token = next_token(rest)) {
      if (n == more.size()) fail("a vertex of more than seven numbers");
      more[n++] = number(token);
    }
    if (n < 3) return;
    piece_.colours.resize(piece_.vertices.size() - 1);
    piece_.colours.push_back({more[n - 3], more[n - 2], more[n - 1]});
    ++piece_.coloured;
  }

  static bool whole(std::string_view text, std::int64_t& value) {
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && stop == text.data() + text.size() && value != 0;
  }

  void read_face(std::string_view rest) {
    Piece::Face face{piece_.corners.size(), 0, row_->line, group_};
    group_.reset();
    for (auto token = next_token(rest); !token.empty(); token = next_token(rest)) {
      if (token.starts_with('#')) break;
      Piece::Corner corner;
      const std::size_t slash = token.find('/');
      if (!whole(token.substr(0, slash), corner.vertex)) fail(quote(token) + " is not a face's corner");
      if (slash != std::string_view::npos) {
        const std::size_t second = token.find('/', slash + 1);
        if (second != std::string_view::npos && !whole(token.substr(second + 1), corner.normal))
          fail(quote(token) + " is not a face's corner");
      }
      corner.relative_vertex = corner.vertex < 0;
      corner.relative_normal = corner.normal < 0;
      if (corner.relative_vertex) corner.vertex += static_cast<std::int64_t>(piece_.vertices.size()) + 1;
      if (corner.relative_normal) corner.normal += static_cast<std::int64_t>(piece_.normals.size()) + 1;
      piece_.corners.push_back(corner);
      ++face.corners;
    }
    piece_.faces.push_back(face);
  }

  void read_group(std::string_view rest) {
    Group group;
    if (parse_group_name(next_token(rest), group.surface, group.primitive)) piece_.named = true;
    group_ = group;
    piece_.group = group;
  }

  const std::string& path_;
  Piece& piece_;
  const Row* row_ = nullptr;
  std::optional<Group> group_;
};

struct Normals {
  std::vector<Eigen::Vector3d> all;
  std::vector<std::uint32_t> of_vertex;  ///< 1-based; 0: none
};

/// Joins the pieces' vertices and, if there is a colour for every vertex, colours.
void join_vertices(const std::vector<Piece>& pieces, const Normals& normals, RawGeometry& geometry) {
  std::size_t coloured = 0;  // vertices
  for (const auto& piece : pieces) coloured += piece.coloured;
  const bool colours = coloured == geometry.count;
  const bool has_normals = normals.of_vertex.size() == geometry.count;
  std::vector<Role> roles = {Role::x, Role::y, Role::z};
  if (colours) roles.insert(roles.end(), {Role::red, Role::green, Role::blue});
  if (has_normals) roles.insert(roles.end(), {Role::nx, Role::ny, Role::nz});
  auto table = std::make_shared<Table>(geometry.count, roles);
  std::size_t i = 0;
  for (const auto& piece : pieces) {
    for (std::size_t k = 0; k < piece.vertices.size(); ++k, ++i) {
      double* to = table->row(i);
      for (int a = 0; a < 3; ++a) *to++ = piece.vertices[k][a];
      for (std::size_t a = 0; colours && a < 3; ++a) *to++ = piece.colours[k][a];
      if (!has_normals || normals.of_vertex[i] == 0) continue;
      for (int a = 0; a < 3; ++a) *to++ = normals.all[normals.of_vertex[i] - 1][a];
    }
  }
  Table::attach(std::move(table), geometry);
}

/// Resolves the corners' indices, in the order of the file.
class FaceJoiner {
 public:
  FaceJoiner(RawGeometry& geometry, Normals& normals) : geometry_(geometry), normals_(normals) {}

  void add(const Piece& piece) {
    std::vector<std::uint32_t> corners;
    for (const auto& face : piece.faces) {
      if (face.group) group_ = *face.group;
      corners.clear();
      for (std::size_t c = face.first; c < face.first + face.corners; ++c)
        corners.push_back(resolve(piece.corners[c], face.line));
      faces_.add(corners, {true, false, true}, {static_cast<std::int32_t>(group_.surface), 0, group_.primitive});
    }
    if (piece.group) group_ = *piece.group;
    vertices_before_ += static_cast<std::int64_t>(piece.vertices.size());
    normals_before_ += static_cast<std::int64_t>(piece.normals.size());
  }
  void finish(bool grouped) {
    std::vector<FaceList> one;
    one.push_back(std::move(faces_));
    FaceList::join(one, geometry_);
    if (grouped) return;
    geometry_.classes.clear();
    geometry_.primitives.clear();
  }

 private:
  std::uint32_t resolve(const Piece::Corner& corner, std::size_t line) {
    const std::int64_t vertex = corner.vertex + (corner.relative_vertex ? vertices_before_ : 0) - 1;
    if (vertex < 0 || vertex >= static_cast<std::int64_t>(geometry_.count))
      vertex_index(static_cast<double>(vertex), geometry_.count, fmt::format("{}:{}", geometry_.path, line));
    const auto index = static_cast<std::uint32_t>(vertex);
    if (corner.normal == 0 && !corner.relative_normal) return index;
    const std::int64_t normal = corner.normal + (corner.relative_normal ? normals_before_ : 0);
    if (normal < 1 || normal > static_cast<std::int64_t>(normals_.all.size()))
      throw Error(fmt::format("{}:{}: a face's corner has normal {}, but there are {}", geometry_.path, line, normal,
                              normals_.all.size()));
    normals_.of_vertex.resize(geometry_.count);
    if (normals_.of_vertex[index] == 0) normals_.of_vertex[index] = static_cast<std::uint32_t>(normal);
    return index;
  }

  RawGeometry& geometry_;
  Normals& normals_;
  FaceList faces_;
  Group group_;
  std::int64_t vertices_before_ = 0, normals_before_ = 0;
};

}  // namespace

RawGeometry read_obj(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  const Lines lines(file->text(), 1, true, context);
  std::vector<Piece> pieces(lines.pieces().size());
  std::vector<std::optional<PieceParser>> parsers(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) parsers[i].emplace(file->path(), pieces[i]);
  lines.for_rows(0, lines.rows(), context, [&](std::size_t piece, const Row& row) { parsers[piece]->read(row); });

  RawGeometry geometry;
  geometry.path = file->path();
  Normals normals;
  bool grouped = false;
  for (const auto& piece : pieces) {
    geometry.count += piece.vertices.size();
    normals.all.insert(normals.all.end(), piece.normals.begin(), piece.normals.end());
    grouped = grouped || piece.named;
  }
  FaceJoiner joiner(geometry, normals);
  for (const auto& piece : pieces) joiner.add(piece);
  joiner.finish(grouped);
  if (geometry.triangles.empty() && normals.all.size() == geometry.count)
    for (std::uint32_t i = 0; i < geometry.count; ++i) normals.of_vertex.push_back(i + 1);
  if (geometry.count > 0) join_vertices(pieces, normals, geometry);
  return geometry;
}

}  // namespace atrium::io
