#pragma once
#include "modules/render/drawing.hpp"
#include "modules/render/overlay.hpp"
#include "modules/render/snapshot.hpp"

namespace atrium::render {

/// More points than this are thinned, for drawing only.
inline constexpr std::size_t most_points = 2000000;

/// Puts a snapshot's inputs into the drawing; adds what explains their colours to the overlay. `open`: rooms are looked
/// into from above, so without ceilings unless the parameters want them. `within`: the camera stands in a room, so
/// ceilings are drawn.
void add_inputs(Drawing& drawing, Overlay& overlay, const Snapshot::In& in, const Snapshot::Params& params, bool open,
                bool within, const Context& context);

}  // namespace atrium::render
