#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/textures.hpp"

namespace atrium::scene {

/// Photographs each wall, floor and ceiling from the colours of the scan, so that the light model looks like the room.
///
/// One image for each primitive of the mesh that is structure; it covers all triangles of that primitive. Its rows are
/// horizontal on walls (unless a turned image is much smaller), and its pixels are squares of `resolution`.
///
/// Which points count: those within `distance` of the plane; with normals only if these point to the plane's side
/// (within 60°), without normals but with sensors only if the scanner stood there. So both faces of a thin wall get
/// pictures of their own. Where several layers lie above one spot the nearest to the plane wins, and spots that are
/// mostly covered by what stands in front (to five times `distance`: the sides of cupboards, say) take their
/// neighbours' colours rather than their own.
///
/// Points are splatted bilinearly and averaged per pixel; pixels without enough points are filled from coarser levels
/// of an image pyramid (pull and push; Gortler et al., "The Lumigraph", 1996), so sparse scans give smooth pictures and
/// holes have no black spots. Colours are averaged as they stand in the file (sRGB).
///
/// A primitive that no point colours has no image, and a cloud without colours gives no images at all, with a warning.
/// Cloud and mesh must be in the same frame; the images are in the mesh's. Errors: triangles without the columns
/// `classes` and `primitives`.
struct BakeTextures {
  static constexpr std::string_view type = "scene.bake_textures";
  static constexpr std::string_view summary = "Makes an image of each wall, floor and ceiling from the scan's colours.";
  struct In {
    Input<Cloud> cloud;
    Input<Mesh> mesh;
  };
  struct Out {
    Textures textures;
  };
  struct Params {
    double resolution = 0.01;
    double distance = 0.05;
    std::int64_t max_side = 4096;
    std::int64_t max_pixels = 32'000'000;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::cloud>("The coloured scan, as dense as it is."),
                 port<&In::mesh>("The structure: triangles with class and primitive, as scene.merge gives them.")};
  static constexpr auto outputs = std::tuple{port<&Out::textures>("Images, by ascending primitive.")};
  static constexpr auto params = std::tuple{
      param<&Params::resolution>(metres, within(0.001, 1), "Side of a pixel."),
      param<&Params::distance>(metres, within(0.001, 0.5), "Points further from the plane do not colour it."),
      param<&Params::max_side>(
          count, within(16, 16384),
          "Most pixels along a side of an image; a larger face gets larger pixels, with a warning."),
      param<&Params::max_pixels>(count, within(1000, 1e9),
                                 "Most pixels of all images together; above, all get larger pixels, with a warning.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::scene
