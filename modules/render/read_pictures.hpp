#pragma once
#include <string>
#include <vector>

#include "graph/api/node.hpp"
#include "modules/types/picture.hpp"

namespace atrium::render {

/// Reads PNG files for a contact sheet: the pictures of several runs.
///
/// A file that is not there is a picture too: an empty one, whose caption says so, in the size of the first that is. So
/// one failed run costs a sheet one cell. Errors: no file is there at all; a file that is no PNG, damaged, not
/// whole or of more than 100 million pixels.
struct ReadPictures {
  static constexpr std::string_view type = "render.read_pictures";
  static constexpr std::string_view summary = "Reads PNG files for a contact sheet.";
  static constexpr bool cached = false;  // it looks for the files itself

  struct Out {
    Pictures pictures;
  };
  struct Params {
    std::vector<std::string> files;
    std::vector<std::string> captions;
  };

  static constexpr auto outputs = std::tuple{port<&Out::pictures>("In the order of the files.")};
  static constexpr auto params =
      std::tuple{param<&Params::files>("PNG files; relative paths are meant from the working folder."),
                 param<&Params::captions>("One text per file; those that lack one get the name of the file.")};

  static Out run(const Params& params, Context& context);
};

}  // namespace atrium::render
