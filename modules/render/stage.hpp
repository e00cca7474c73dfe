#pragma once
#include "modules/render/drawing.hpp"
#include "modules/render/overlay.hpp"
#include "modules/render/snapshot.hpp"

namespace atrium::render {

/// More points than this are thinned, for drawing only.
inline constexpr std::size_t most_points = 2000000;

/// Where a picture is taken from: a named view from above (rooms are looked into, so the tops of clouds are cut off),
/// another named view from outside, an explicit place, or a place within a room (ceilings are drawn).
enum class Camera { above, level, placed, inside };

/// Puts a snapshot's inputs into the drawing; adds what explains their colours to the overlay.
void add_inputs(Drawing& drawing, Overlay& overlay, const Snapshot::In& in, const Snapshot::Params& params,
                Camera camera, const Context& context);

}  // namespace atrium::render
