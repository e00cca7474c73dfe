#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "graph/api/node.hpp"
#include "modules/types/adjacency.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/ground_truth.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/picture.hpp"
#include "modules/types/plane_meshes.hpp"
#include "modules/types/plane_primitives.hpp"
#include "modules/types/structure.hpp"
#include "modules/types/textures.hpp"

namespace atrium::render {

/// Draws any stage of a run into PNG files, without a display (VTK on EGL's surfaceless platform).
///
/// All inputs are optional, at least one must be wired; they are drawn together. Inputs in another frame than z up come
/// with the transform that brings them there: `transform` applies to all of them. The camera fits the meshes and the
/// cloud without its outermost 0.1 %; triangles far away from all others do not count if they are few. Of more than 2
/// million points every second, third, … is drawn. A named view that would hide something under the legend or the title
/// is drawn a little smaller. Errors: nothing to draw; an unknown view or colour map; a view that
/// is named twice; a file that is no .png; a camera that is not a place and a target; no way to render on this machine.
struct Snapshot {
  static constexpr std::string_view type = "render.snapshot";
  static constexpr std::string_view summary = "Draws clouds, primitives and meshes into PNG files, without a display.";

  struct In {
    OptionalInput<Cloud> cloud;
    OptionalInput<PlanePrimitives> planes;
    OptionalInput<Structure> structure;
    OptionalInput<PlaneMeshes> meshes;
    OptionalInput<Adjacency> adjacency;
    OptionalInput<Mesh> mesh;
    OptionalInput<Textures> textures;
    OptionalInput<Mesh> objects;
    OptionalInput<GroundTruth> truth;
    OptionalInput<Mesh> reference;
    OptionalInput<Transform> transform;
  };
  struct Out {
    Pictures pictures;
  };
  enum class ColourBy { automatic, colour, height, label, distance, signed_distance, plain };
  enum class Background { white, black };
  enum class NearWalls { automatic, drawn, hidden };
  enum class Empty { error, blank };
  struct Params {
    OutputPath path{"snapshot.png"};
    std::vector<std::string> views{"isometric"};
    std::vector<double> eye;
    std::vector<double> target;
    std::int64_t width = 1280;
    std::int64_t height = 960;
    ColourBy colour_by = ColourBy::automatic;
    std::string colour_map;
    double scale_end = 0;
    double point_size = 0;
    bool perspective = false;
    double field_of_view = 0;
    bool fit = false;
    double view_width = 0;
    bool ceilings = false;
    NearWalls near_walls = NearWalls::automatic;
    double cut_below_top = 0.4;
    bool edges = true;
    bool legend = true;
    bool scale_bar = true;
    std::string title;
    double text_size = 0.022;
    Background background = Background::white;
    Empty empty = Empty::error;
  };

  static constexpr auto inputs = std::tuple{
      port<&In::cloud>("Points."),
      port<&In::planes>("Planar primitives: their points, a colour each, the others grey."),
      port<&In::structure>("The points of walls, floors and ceilings, coloured by class."),
      port<&In::meshes>("Planar meshes, coloured by class."),
      port<&In::adjacency>("Drawn as lines between the centres of `meshes`, which it needs."),
      port<&In::mesh>("A structural or scene mesh, coloured by class."),
      port<&In::textures>("Images for the faces of `mesh`, in its frame; the others keep their class's colour."),
      port<&In::objects>("A mesh of furniture."),
      port<&In::truth>("Ground truth of a simulated scene, coloured by class."),
      port<&In::reference>("What `colour_by: distance` measures to, in the cloud's frame. It is not drawn."),
      port<&In::transform>("From the inputs' frame to z up; without it they are taken to be z up.")};
  static constexpr auto outputs = std::tuple{port<&Out::pictures>("One per view, for a contact sheet.")};
  static constexpr auto params = std::tuple{
      param<&Params::path>("PNG file; with several views the view's name is added before the extension."),
      param<&Params::views>("Any of isometric, top, front, back, left, right, inside. Walls that face away are "
                            "left out (near_walls), so that rooms are seen from outside. Inside stands at eye height "
                            "(1.6 m above the lowest floor), "
                            "over floor, away from what is in the way, and looks to where most floor is seen."),
      param<&Params::eye>(metres, unbounded,
                          "Explicit camera: where it stands, [x, y, z] in the z-up frame, in "
                          "place of `views`; needs `target`."),
      param<&Params::target>(metres, unbounded, "Explicit camera: what it looks at, [x, y, z]."),
      param<&Params::width>(count, within(16, 8192), "Pixels across."),
      param<&Params::height>(count, within(16, 8192), "Pixels down."),
      param<&Params::colour_by>(
          {{"automatic", ColourBy::automatic},
           {"colour", ColourBy::colour},
           {"height", ColourBy::height},
           {"label", ColourBy::label},
           {"distance", ColourBy::distance},
           {"signed_distance", ColourBy::signed_distance},
           {"plain", ColourBy::plain}},
          "Colour of the cloud; automatic: distance if `reference` is wired, else its own colours where it has them, "
          "else height. A signed distance is positive on the side that the reference's faces look to. Heights and "
          "distances come with a colour bar."),
      param<&Params::colour_map>(
          "A file of share/colormaps by its name: viridis, cividis, cool_warm, okabe_ito; empty: viridis for heights, "
          "cividis for distances, cool_warm for those with a sign, okabe_ito for labels. All are made for the "
          "colour-blind."),
      param<&Params::scale_end>(
          metres, within(0, 1000),
          "Where the scale of distances ends; larger ones have its last colour. 0: the next round length (1, 2 or 5 "
          "times "
          "a power of ten) above the 95th percentile of the points that are drawn."),
      param<&Params::point_size>(
          unitless, within(0, 50),
          "Pixels; 0: as large as the points are apart on the surfaces, within 1/480 and 1/120 of the picture's "
          "height."),
      param<&Params::perspective>("Perspective instead of parallel projection."),
      param<&Params::field_of_view>(degrees, within(0, 170),
                                    "Of perspective views, from the top to the bottom of the picture. 0: 62 of the "
                                    "view inside and of an explicit "
                                    "camera, 30 of the others."),
      param<&Params::fit>(
          "Of the explicit camera only the direction counts: it stands where all that is drawn just fits."),
      param<&Params::view_width>(metres, within(0, 1e6),
                                 "What a named view shows from left to right, at the middle of what is drawn: pictures "
                                 "with the same width have "
                                 "one scale. 0: so that all that is drawn fits."),
      param<&Params::ceilings>(
          "Draw ceilings too, in the named views with every face from both sides: the building as it is seen from "
          "outside. The view inside always has them."),
      param<&Params::near_walls>(
          {{"automatic", NearWalls::automatic}, {"drawn", NearWalls::drawn}, {"hidden", NearWalls::hidden}},
          "Whether faces that look away from the camera are drawn. automatic: not in the named views without ceilings, "
          "so that rooms are looked into; else they are."),
      param<&Params::cut_below_top>(
          metres, within(0, 100),
          "Points nearer than this to the top of the cloud are left out in the isometric and top views, so that rooms "
          "are looked into; not with `ceilings`. A cloud that is lower than twice this is drawn whole."),
      param<&Params::edges>("Draw the outlines of faces."),
      param<&Params::legend>("Name the classes' colours."),
      param<&Params::scale_bar>("A bar of known length (parallel projection only), and the bar that explains colours."),
      param<&Params::title>("Text at the top."),
      param<&Params::text_size>(
          ratio, within(0.005, 0.1),
          "Height of a line of text as a share of the picture's height: larger for pictures that will be shrunk."),
      param<&Params::background>({{"white", Background::white}, {"black", Background::black}}, ""),
      param<&Params::empty>({{"error", Empty::error}, {"blank", Empty::blank}},
                            "Where there is nothing to draw: an error, or a picture that says so, for sheets of scans "
                            "of which some have no furniture.")};

  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::render
