#pragma once
#include <string>
#include <string_view>

#include "graph/api/context.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/plane_primitives.hpp"

/// Names of coordinate reference systems, as the writers of georeferenced files have them.
namespace atrium {

/// The short name of a coordinate reference system: "EPSG:25832" of that, of a URN (urn:ogc:def:crs:EPSG::25832), of an
/// address (https://www.opengis.net/def/crs/EPSG/0/25832) and of well-known text whose projected system has an EPSG
/// code of its own (of a compound one with heights the code of the projected part); of other well-known text the name
/// that it begins with. Empty for an empty text. Throws Error, which says how a name is written, for all else, and for
/// systems that are known to count in degrees: coordinates here are metres.
std::string crs_name(const std::string& text);
/// Throws crs_name()'s Error: for parameters, before anything runs.
void check_crs_name(const std::string& text);

/// The number in "EPSG:25832"; 0 for a name without one.
int epsg_code(const std::string& name);

/// The name of the system that an output is in: that of `given` (a parameter `crs`), or, where it is empty, that of the
/// scan, which may be null. It is empty where the scan is in another unit than metres (its system counts in that unit,
/// the output does not; io.read_scan warns of it, once for all outputs), and, with a warning, where the scan's file
/// names a system in a way that is not understood. Throws Error for a `given` one that is none.
std::string crs_of(const std::string& given, const Cloud* scan, const Context& context);

/// As above, of a `what` ("plan", "building") that `upright`, which leads out of the input's frame, turns upright: by
/// more than 10 degrees it is in no such system, and the name is empty, with a warning.
std::string crs_of(const std::string& given, const Cloud* scan, const Transform& upright, std::string_view what,
                   const Context& context);

}  // namespace atrium
