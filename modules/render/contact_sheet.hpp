#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "graph/api/node.hpp"
#include "modules/types/picture.hpp"

namespace atrium::render {

/// Several pictures with captions on one sheet: the stages of a run, or the variants of a parameter.
///
/// Pictures stand in the order of the inputs, row by row, each shrunk to fit its cell; captions that are wider than
/// their cell are cut, with "…". Errors: no picture at all; a sheet of more than 100 million pixels; a file that is no
/// .png.
struct ContactSheet {
  static constexpr std::string_view type = "render.contact_sheet";
  static constexpr std::string_view summary = "Puts several pictures with captions on one sheet.";

  struct In {
    Inputs<Pictures> pictures;
  };
  struct Out {
    Pictures sheet;
  };
  struct Params {
    OutputPath path{"sheet.png"};
    std::int64_t columns = 2;
    std::int64_t cell_width = 640;
    double caption_size = 0.05;
    std::vector<std::string> captions;
  };

  static constexpr auto inputs = std::tuple{port<&In::pictures>("What to show, in this order.")};
  static constexpr auto outputs = std::tuple{port<&Out::sheet>("The sheet, one picture.")};
  static constexpr auto params = std::tuple{
      param<&Params::path>("PNG file, NAME.png."), param<&Params::columns>(count, within(1, 20), "Pictures in a row."),
      param<&Params::cell_width>(count, within(64, 4096),
                                 "Pixels across for each picture; its height follows from the first picture's shape."),
      param<&Params::caption_size>(ratio, within(0.01, 0.2),
                                   "Size of the captions' letters as a share of a picture's width."),
      param<&Params::captions>(
          "One text per picture, in their order; fewer are filled up with the pictures' own captions.")};

  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::render
