#pragma once
#include <map>

#include "graph/report/sweep_record.hpp"

namespace atrium::report {

/// A file that is part of a report, as it stands in the page.
struct Attachment {
  std::string media_type;  ///< "image/png", "model/gltf-binary", …
  bool deflated = false;
  std::string base64;
};

/// The pictures and models of all variants. A file that several variants share is there once.
struct Attachments {
  struct Use {
    std::string path;  ///< relative to the variant's folder
    std::size_t file;  ///< index into files
  };
  struct Variant {
    std::vector<Use> pictures, models;
  };
  std::vector<Attachment> files;
  std::vector<Variant> variants;
  std::vector<std::string> notes;  ///< what was left out, and why
  std::size_t pictures = 0, models = 0;
};

struct AttachmentOptions {
  std::vector<std::string> models;      ///< paths of the models to take; empty: chosen by what most variants have
  std::size_t most_models = 1'000'000;  ///< so many variants get theirs
  std::size_t max_bytes = 150'000'000;  ///< of all files, as they stand in the page
};

/// Reads them. Pictures are .png, .jpg and .svg files, models .glb and .ply files with faces. Where nothing is asked
/// for, the models are of one path that most variants have, .glb before .ply, the smallest first. Pictures get up to
/// half of the room before models get the rest. Throws Error if no variant has a model that is asked for.
Attachments attach(const SweepRecord& record, const AttachmentOptions& options);

}  // namespace atrium::report
