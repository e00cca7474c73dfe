#pragma once
#include <cmath>
#include <cstdlib>
#include <functional>

#include "files.hpp"
#include "tests/support/e57_builder.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/las_builder.hpp"

/// Files of a few points in every format, as text makes them.
namespace atrium::io::point_files {

/// Coordinates as they are written: also "nan" and "inf".
using Points = std::vector<std::array<std::string, 3>>;

inline double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

inline std::string rows(const Points& points, const std::string& before = "", const std::string& after = "",
                        const std::string& between = " ") {
  std::string text;
  for (const auto& p : points) text += before + p[0] + between + p[1] + between + p[2] + after + "\n";
  return text;
}

template <class T>
std::string numbers(const Points& points, bool swapped = false) {
  std::string bytes;
  for (const auto& p : points)
    for (const auto& v : p) put(bytes, static_cast<T>(number(v)), swapped);
  return bytes;
}

inline std::string ply(const Points& points, const std::string& format, const std::string& body) {
  return "ply\nformat " + format + " 1.0\ncomment of a test\nelement vertex " + std::to_string(points.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nend_header\n" + body;
}

inline std::string pcd(const Points& points, const std::string& data, const std::string& body) {
  const std::string n = std::to_string(points.size());
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + n +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA " + data + "\n" + body;
}

/// Field after field, in pieces of literal bytes.
inline std::string compressed_pcd(const Points& points) {
  std::string data, packed, body;
  for (std::size_t a = 0; a < 3; ++a)
    for (const auto& p : points) put(data, number(p[a]));
  for (std::size_t i = 0; i < data.size(); i += 32) {
    const std::string piece = data.substr(i, 32);
    packed += static_cast<char>(piece.size() - 1) + piece;
  }
  put(body, static_cast<std::uint32_t>(packed.size()));
  put(body, static_cast<std::uint32_t>(data.size()));
  return pcd(points, "binary_compressed", body + packed);
}

/// Facets that all begin with the first two points.
inline Points facets(const Points& points) {
  Points corners;
  for (std::size_t i = 2; i < points.size(); ++i)
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}, i}) corners.push_back(points[k]);
  return corners;
}

inline std::string text_stl(const Points& points) {
  std::string text = "solid of a test\n";
  const Points corners = facets(points);
  for (std::size_t i = 0; i < corners.size(); i += 3)
    text +=
        "facet normal 0 0 1\nouter loop\n" +
        rows({corners.begin() + static_cast<std::ptrdiff_t>(i), corners.begin() + static_cast<std::ptrdiff_t>(i + 3)},
             "vertex ") +
        "endloop\nendfacet\n";
  return text + "endsolid of a test\n";
}

inline std::string binary_stl(const Points& points) {
  const Points corners = facets(points);
  std::string bytes(80, ' ');
  put(bytes, static_cast<std::uint32_t>(corners.size() / 3));
  for (std::size_t i = 0; i < corners.size(); i += 3)
    bytes += std::string(12, '\0') +
             numbers<float>({corners.begin() + static_cast<std::ptrdiff_t>(i),
                             corners.begin() + static_cast<std::ptrdiff_t>(i + 3)}) +
             std::string(2, '\0');
  return bytes;
}

inline std::string ptx(const Points& points) {
  return std::to_string(points.size()) + "\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n" +
         rows(points, "", " 0.5");
}

inline std::string e57(const Points& points, std::int64_t records = -1) {
  test::E57TestScan scan;
  const char* names[3] = {"cartesianX", "cartesianY", "cartesianZ"};
  for (std::size_t a = 0; a < 3; ++a) {
    std::vector<double> values;
    for (const auto& p : points) values.push_back(number(p[a]));
    scan.streams.push_back(test::f64(names[a], values));
  }
  scan.records = records;
  return test::E57Builder().add(scan).file();
}

inline std::string las(const Points& points) {
  test::LasBuilder builder;
  builder.scale = 0.005;
  for (const auto& p : points) {
    test::LasBuilder::Point point;
    std::int32_t* const to[3] = {&point.x, &point.y, &point.z};
    for (std::size_t a = 0; a < 3; ++a) *to[a] = static_cast<std::int32_t>(std::lround(number(p[a]) / builder.scale));
    builder.add(point);
  }
  return builder.file();
}

inline test::GltfBuilder gltf(const Points& points) {
  std::vector<float> values;
  for (const auto& p : points)
    for (const auto& v : p) values.push_back(static_cast<float>(number(v)));
  test::GltfBuilder builder;
  builder.add(values, "VEC3", 3);
  builder.primitives = {R"({"attributes":{"POSITION":0},"mode":0})"};
  return builder;
}

struct Format {
  std::string name;
  std::function<std::string(const Points&)> make;
  bool text = false;          ///< all of it; else there may be a header of text
  std::string end_of_header;  ///< of a binary file with a header of lines
  bool any_number = true;     ///< has NaN and infinities
  bool keeps_utm = true;      ///< has double coordinates
  /// Of a file's bytes, where more points are declared.
  std::function<std::string(std::string)> declare = nullptr;
};

inline std::string replace_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

inline std::string put_count(std::string bytes, std::size_t at) {
  const std::uint32_t count = 1000000000;
  std::memcpy(bytes.data() + at, &count, 4);
  return bytes;
}

}  // namespace atrium::io::point_files
