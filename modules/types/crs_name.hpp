#pragma once
#include <string>

#include "graph/api/context.hpp"
#include "modules/types/cloud.hpp"

/// Names of coordinate reference systems, as the writers of georeferenced files have them.
namespace atrium {

/// The short name of a coordinate reference system: "EPSG:25832" of that, of a URN (urn:ogc:def:crs:EPSG::25832), of an
/// address (https://www.opengis.net/def/crs/EPSG/0/25832) and of well-known text that names its EPSG code; of other
/// well-known text the name that it begins with. Empty for an empty text. Throws Error, which says how a name is
/// written, for all else, and for systems that are known to count in degrees: coordinates here are metres.
std::string crs_name(const std::string& text);

/// The number in "EPSG:25832"; 0 for a name without one.
int epsg_code(const std::string& name);

/// The name of the system that an output is in: that of `given` (a parameter `crs`), or, where it is empty, that of the
/// scan, which may be null. It is empty, with a warning, where the scan is in another unit than metres (its system
/// counts in that unit, the output does not) and where the scan's file names a system in a way that is not understood.
/// Throws Error for a `given` one that is none.
std::string crs_of(const std::string& given, const Cloud* scan, const Context& context);

}  // namespace atrium
