#pragma once
#include <string_view>

#include "graph/report/attachments.hpp"

namespace atrium::report {

/// What the page that shows one run asks for. The page itself says it, in its element `wishes`: which files it can show
/// and which node types write them is no knowledge of the program.
struct ViewWish {
  std::string part;                ///< what the page calls it: "plan"
  std::vector<std::string> files;  ///< names of files, the best first
  std::string node;                ///< the node type that writes it, for a file of another name, and to be named
};
struct ViewWishes {
  std::vector<ViewWish> parts;                                  ///< in the order in which they get their room
  std::vector<std::pair<std::string, std::string>> parameters;  ///< node type, parameter: whose values it wants
};

/// Reads them from the page. Throws Error if it has none, or none that can be understood.
ViewWishes read_wishes(std::string_view page, const std::string& name);

struct ViewPart {
  std::string part;
  std::string path;     ///< relative to the run's folder; empty: there is none
  std::string node;     ///< that wrote it; empty if no node says so
  std::string lacking;  ///< what is wrong with it, or which node would write it
  std::string note;     ///< what of the file is not in the page
  std::size_t file = 0;
};
/// One run as the page shows it.
struct View {
  std::vector<ViewPart> parts;
  std::vector<Attachment> files;
  std::size_t lacking = 0;  ///< parts without a file
};

/// Reads the files that are wished for, of a run, up to `max_bytes` as they stand in the page. A part has the first of
/// its files that is in the run's folder and has room; else a file of its node type with the same extension. A GLB file
/// of points that has no room is thinned until it has, to a thousand points at least, which is noted. What has more
/// bytes than 32 times the room is not read, but for such a file up to 1 GB.
View pack_view(const RunRecord& run, const ViewWishes& wishes, std::size_t max_bytes);

/// Writes the page about a run with its files, all of it at most `max_bytes`: beside, then renamed. Gives what is in it
/// and its size. Throws Error, also if the page was not built, or if it is larger even so.
std::pair<View, std::size_t> write_view(const std::filesystem::path& target, const RunRecord& run,
                                        const std::filesystem::path& page, std::size_t max_bytes);

}  // namespace atrium::report
