#include "modules/building/ifc_shapes.hpp"

#include <map>

namespace atrium::building {
namespace {

using step::choice, step::list, step::none, step::real, step::reals, step::refs, step::text, step::truth, step::whole;

constexpr double precision = 1e-5;  // metres: points nearer than that are one, for programs that ask

struct Paint {
  std::array<double, 3> colour;
  double transparency;
};

const std::map<std::string_view, Paint>& paints() {
  static const std::map<std::string_view, Paint> table{
      {"wall", {{0.86, 0.84, 0.80}, 0}},      {"wall of assumed thickness", {{0.74, 0.78, 0.84}, 0}},
      {"slab", {{0.62, 0.62, 0.62}, 0}},      {"roof", {{0.62, 0.36, 0.30}, 0}},
      {"column", {{0.72, 0.70, 0.68}, 0}},    {"door", {{0.55, 0.38, 0.22}, 0}},
      {"window", {{0.60, 0.78, 0.88}, 0.5}},  {"space", {{0.45, 0.70, 0.45}, 0.7}},
      {"opening", {{0.90, 0.55, 0.20}, 0.6}}, {"furniture", {{0.80, 0.70, 0.45}, 0}}};
  return table;
}

StepValue indices(const std::vector<std::uint32_t>& ring) {
  std::vector<StepValue> values;
  values.reserve(ring.size());
  for (const auto v : ring) values.push_back(whole(v + 1));
  return list(values);
}

StepValue places(const std::vector<Eigen::Vector3d>& points) {
  std::vector<StepValue> values;
  values.reserve(points.size());
  for (const auto& p : points) values.push_back(reals({p.x(), p.y(), p.z()}));
  return list(values);
}

}  // namespace

IfcShapes::IfcShapes(StepFile& file) : file_(file) {
  model_ = file_.add("IFCGEOMETRICREPRESENTATIONCONTEXT",
                     {none(), text("Model"), whole(3), real(precision), axes({}), none()});
  const auto part = [&](std::string_view name, std::string_view view) {
    return file_.add("IFCGEOMETRICREPRESENTATIONSUBCONTEXT",
                     {text(name), text("Model"), step::derived(), step::derived(), step::derived(), step::derived(),
                      model_, none(), choice(view), none()});
  };
  body_ = part("Body", "MODEL_VIEW");
  axis_ = part("Axis", "GRAPH_VIEW");
}

StepRef IfcShapes::point(const Eigen::Vector3d& p) {
  return file_.shared("IFCCARTESIANPOINT", {reals({p.x(), p.y(), p.z()})});
}
StepRef IfcShapes::point(const Eigen::Vector2d& p) {
  return file_.shared("IFCCARTESIANPOINT", {reals({p.x(), p.y()})});
}
StepRef IfcShapes::direction(const Eigen::Vector3d& d) {
  return file_.shared("IFCDIRECTION", {reals({d.x(), d.y(), d.z()})});
}

StepRef IfcShapes::axes(const IfcFrame& frame) {
  return file_.shared("IFCAXIS2PLACEMENT3D", {point(frame.location), direction(frame.axis), direction(frame.across)});
}

StepRef IfcShapes::placement(StepRef parent, const IfcFrame& frame) {
  return file_.add("IFCLOCALPLACEMENT", {parent, axes(frame)});
}

StepRef IfcShapes::polyline(const PlanRing& corners, bool closed) {
  std::vector<StepRef> points;
  for (const auto& p : corners) points.push_back(point(p));
  if (closed) points.push_back(points.front());
  return file_.add("IFCPOLYLINE", {refs(points)});
}

StepRef IfcShapes::profile(const PlanPolygon& polygon) {
  const StepRef outline = polyline(polygon.outline, true);
  if (polygon.holes.empty()) return file_.add("IFCARBITRARYCLOSEDPROFILEDEF", {choice("AREA"), none(), outline});
  std::vector<StepRef> holes;
  for (const auto& hole : polygon.holes) holes.push_back(polyline(hole, true));
  return file_.add("IFCARBITRARYPROFILEDEFWITHVOIDS", {choice("AREA"), none(), outline, refs(holes)});
}

StepRef IfcShapes::extruded(const PlanPolygon& polygon, const IfcFrame& frame, const Eigen::Vector3d& along,
                            double depth, std::string_view colour) {
  const StepRef solid =
      file_.add("IFCEXTRUDEDAREASOLID", {profile(polygon), axes(frame), direction(along), real(depth)});
  paint(solid, colour);
  return solid;
}

StepRef IfcShapes::faceted(const PolygonSurface& surface, std::string_view colour) {
  std::vector<StepRef> faces;
  for (const auto& face : surface.faces) {
    if (face.holes.empty()) {
      faces.push_back(file_.add("IFCINDEXEDPOLYGONALFACE", {indices(face.outline)}));
      continue;
    }
    std::vector<StepValue> holes;
    for (const auto& hole : face.holes) holes.push_back(indices(hole));
    faces.push_back(file_.add("IFCINDEXEDPOLYGONALFACEWITHVOIDS", {indices(face.outline), list(holes)}));
  }
  const StepRef points = file_.add("IFCCARTESIANPOINTLIST3D", {places(surface.points)});
  const StepRef solid = file_.add("IFCPOLYGONALFACESET", {points, truth(true), refs(faces), none()});
  paint(solid, colour);
  return solid;
}

StepRef IfcShapes::triangles(const std::vector<Eigen::Vector3d>& points,
                             const std::vector<std::array<std::uint32_t, 3>>& corners, bool closed,
                             std::string_view colour) {
  std::vector<StepValue> values;
  values.reserve(corners.size());
  for (const auto& [a, b, c] : corners) values.push_back(indices({a, b, c}));
  const StepRef list_of_points = file_.add("IFCCARTESIANPOINTLIST3D", {places(points)});
  const StepRef solid =
      file_.add("IFCTRIANGULATEDFACESET", {list_of_points, none(), truth(closed), list(values), none()});
  paint(solid, colour);
  return solid;
}

StepRef IfcShapes::body(const std::vector<StepRef>& items, std::string_view type) {
  return file_.add("IFCSHAPEREPRESENTATION", {body_, text("Body"), text(type), refs(items)});
}

StepRef IfcShapes::axis_line(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return file_.add("IFCSHAPEREPRESENTATION",
                   {axis_, text("Axis"), text("Curve2D"), refs({polyline({from, to}, false)})});
}

StepRef IfcShapes::shape(const std::vector<StepRef>& representations) {
  return file_.add("IFCPRODUCTDEFINITIONSHAPE", {none(), none(), refs(representations)});
}

void IfcShapes::paint(StepRef item, std::string_view colour) {
  const auto found = paints().find(colour);
  if (found == paints().end()) return;
  const auto& [rgb, transparency] = found->second;
  const StepRef value = file_.shared("IFCCOLOURRGB", {none(), real(rgb[0]), real(rgb[1]), real(rgb[2])});
  const StepRef shading = file_.shared("IFCSURFACESTYLERENDERING", {value, real(transparency), none(), none(), none(),
                                                                    none(), none(), none(), choice("NOTDEFINED")});
  const StepRef style = file_.shared("IFCSURFACESTYLE", {text(colour), choice("BOTH"), refs({shading})});
  file_.add("IFCSTYLEDITEM", {item, refs({style}), none()});
}

PolygonSurface prism(const PlanPolygon& polygon, const std::vector<double>& low, const std::vector<double>& high) {
  PolygonSurface surface;
  PolygonSurface::Face foot, head;
  const auto add_ring = [&](const PlanRing& ring, bool hole) {
    const auto first = static_cast<std::uint32_t>(surface.points.size());
    const auto n = static_cast<std::uint32_t>(ring.size());
    std::vector<std::uint32_t> up, down;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::size_t corner = first / 2 + i;
      surface.points.emplace_back(ring[i].x(), ring[i].y(), low[corner]);
      surface.points.emplace_back(ring[i].x(), ring[i].y(), high[corner]);
      const std::uint32_t here = first + 2 * i, next = first + 2 * ((i + 1) % n);
      surface.faces.push_back({{here, next, next + 1, here + 1}, {}});
      up.push_back(here + 1);
      down.insert(down.begin(), here);
    }
    if (hole) {
      head.holes.push_back(up);
      foot.holes.push_back(down);
    } else {
      head.outline = up;
      foot.outline = down;
    }
  };
  add_ring(polygon.outline, false);
  for (const auto& hole : polygon.holes) add_ring(hole, true);
  surface.faces.push_back(foot);
  surface.faces.push_back(head);
  return surface;
}

}  // namespace atrium::building
