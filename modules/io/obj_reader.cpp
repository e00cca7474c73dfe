#include "modules/io/obj_reader.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
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
  std::size_t unread = 0;      ///< surfaces that are not of faces
};

class PieceParser {
 public:
  PieceParser(const std::string& path, Piece& piece) : path_(path), piece_(piece) {}

  void read(const Row& row) {
    row_ = &row;
    std::string_view rest = row.text;
    const std::string keyword = lower_case(next_token(rest));
    if (keyword == "v")
      read_vertex(rest);
    else if (keyword == "vn")
      piece_.normals.push_back(vector(rest));
    else if (keyword == "f" || keyword == "fo")  // fo: in old files
      read_face(rest);
    else if (keyword == "g" || keyword == "o")
      read_group(rest);
    else if (is_surface(keyword))
      ++piece_.unread;
  }

 private:
  /// Free-form surfaces, and the patches of old files.
  static bool is_surface(std::string_view keyword) {
    return keyword == "surf" || keyword == "bsp" || keyword == "bzp" || keyword == "cdp";
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}:{}: {}", path_, row_->line, what));
  }

  double number(std::string_view token) const {
    double v = 0;
    if (token.empty()) fail("the line ends before its third number");
    if (!parse_number(token, v)) fail(no_number(token));
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
    for (auto token = next_token(rest); !token.empty() && !token.starts_with('#'); token = next_token(rest)) {
      if (n == more.size()) fail("a vertex of more than seven numbers");
      more[n++] = number(token);
    }
    if ((n == 1 || n == 4) && more[0] != 0 && std::isfinite(more[0])) piece_.vertices.back() /= more[0];
    if (n < 3) return;
    piece_.colours.resize(piece_.vertices.size() - 1);
    piece_.colours.push_back({more[n - 3], more[n - 2], more[n - 1]});
    ++piece_.coloured;
  }

  static bool whole(std::string_view text, std::int64_t& value) {
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && stop == text.data() + text.size() && value != 0;
  }

  /// vertex, vertex/texture, vertex/texture/normal or vertex//normal; what comes behind the vertex may be empty.
  static bool read_corner(std::string_view token, Piece::Corner& corner) {
    std::array<std::string_view, 3> parts;
    for (auto& part : parts) {
      const std::size_t length = std::min(token.find('/'), token.size());
      part = token.substr(0, length);
      token.remove_prefix(std::min(length + 1, token.size()));
    }
    return token.empty() && whole(parts[0], corner.vertex) && (parts[2].empty() || whole(parts[2], corner.normal));
  }

  void read_face(std::string_view rest) {
    Piece::Face face{piece_.corners.size(), 0, row_->line, group_};
    group_.reset();
    for (auto token = next_token(rest); !token.empty(); token = next_token(rest)) {
      if (token.starts_with('#')) break;
      Piece::Corner corner;
      if (!read_corner(token, corner)) fail(quote(token) + " is not a face's corner");
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
      vertex_index(static_cast<double>(vertex), geometry_.count, fmt::format("{}:{}", geometry_.path, line), 1);
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

bool is_obj_blank(char c) { return c == ' ' || c == '\t'; }

/// Whether a line that begins so goes on behind a backslash: names of files and groups may end with one.
bool may_go_on(std::string_view line) {
  const std::string keyword = lower_case(next_token(line));
  return keyword == "v" || keyword == "vn" || keyword == "vt" || keyword == "f" || keyword == "l" || keyword == "p";
}

/// The text with lines that end with a backslash joined to the next; the line ends stand behind, so that lines keep
/// their numbers. Nothing if there are none.
std::optional<std::string> joined_lines(std::string_view text) {
  std::string joined;
  std::size_t copied = 0, line = 0, owed = 0;  // owed: line ends that were taken away
  for (std::size_t at = text.find_first_of("\\\r\n"); at != std::string_view::npos;
       at = text.find_first_of("\\\r\n", at)) {
    if (text[at] != '\\') {
      const std::size_t end = at + (text[at] == '\r' && text.substr(at + 1).starts_with('\n') ? 2 : 1);
      if (owed > 0) joined.append(text, copied, end - copied).append(owed, '\n');
      if (owed > 0) copied = end;
      owed = 0;
      line = at = end;
      continue;
    }
    std::size_t end = at + 1;
    while (end < text.size() && is_obj_blank(text[end])) ++end;
    if (end == text.size() || (text[end] != '\r' && text[end] != '\n') ||
        (owed == 0 && !may_go_on(text.substr(line, at - line)))) {
      at = end;
      continue;
    }
    joined.append(text, copied, at - copied).append(1, ' ');
    end += text[end] == '\r' && text.substr(end + 1).starts_with('\n') ? 2 : 1;
    copied = at = end;
    ++owed;
  }
  if (copied == 0) return std::nullopt;
  return joined.append(text, copied);
}

}  // namespace

RawGeometry read_obj(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  const std::string_view text = without_mark(file->text());
  const auto joined = text.find('\\') == std::string_view::npos ? std::nullopt : joined_lines(text);
  const Lines lines(joined ? *joined : text, 1, true, context);
  std::vector<Piece> pieces(lines.pieces().size());
  std::vector<std::optional<PieceParser>> parsers(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) parsers[i].emplace(file->path(), pieces[i]);
  lines.for_rows(0, lines.rows(), context, [&](std::size_t piece, const Row& row) { parsers[piece]->read(row); });

  RawGeometry geometry;
  geometry.path = file->path();
  geometry.y_up = true;
  Normals normals;
  bool grouped = false;
  std::size_t unread = 0;
  for (const auto& piece : pieces) {
    unread += piece.unread;
    geometry.count += piece.vertices.size();
    normals.all.insert(normals.all.end(), piece.normals.begin(), piece.normals.end());
    grouped = grouped || piece.named;
  }
  if (unread > 0)
    context.warn(fmt::format("{}: {} not read, only faces", geometry.path,
                             counted(unread, "curved surface or patch is", "curved surfaces or patches are")));
  FaceJoiner joiner(geometry, normals);
  for (const auto& piece : pieces) joiner.add(piece);
  joiner.finish(grouped);
  if (geometry.triangles.empty() && normals.all.size() == geometry.count)
    for (std::uint32_t i = 0; i < geometry.count; ++i) normals.of_vertex.push_back(i + 1);
  if (geometry.count > 0) join_vertices(pieces, normals, geometry);
  return geometry;
}

}  // namespace atrium::io
