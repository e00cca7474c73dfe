#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "graph/pipeline/pipeline.hpp"

namespace atrium {

/// Where a picture comes from: two iTXt chunks of a PNG file, "atrium:run" and "atrium:resolved".
struct PngStamp {
  std::string run;       ///< the run's id
  std::string resolved;  ///< the pipeline as a file; relative paths are meant from the working folder of the run
};

/// The stamp of a pipeline's run: paths in the working folder are relative to it, so that the picture can be made again
/// elsewhere. The id is 16 hexadecimal digits from the hash of the resolved file. No time is in it: the same run again
/// has the same id.
PngStamp stamp_of(const Pipeline& pipeline);

/// Whether the file begins like a PNG file. False if it cannot be read.
bool is_png(const std::filesystem::path& file);

/// Puts the stamp into a PNG file in place of one that it has: written beside, then renamed. Throws Error if the file
/// is no whole PNG file or cannot be written.
void stamp_png(const std::filesystem::path& file, const PngStamp& stamp);

/// The same of a file's bytes.
bool is_png_text(std::string_view bytes);

/// Reads the stamp back from the file's bytes. Throws Error if they are no whole PNG file or have no stamp.
PngStamp read_png_stamp(std::string_view bytes, const std::filesystem::path& file);
PngStamp read_png_stamp(const std::filesystem::path& file);

}  // namespace atrium
