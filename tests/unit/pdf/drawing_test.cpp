// The program that draws, and what it is handed.
#include "modules/pdf/drawing.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "graph/api/helper_process.hpp"
#include "modules/pdf/write_plan.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/floorplan/buildings.hpp"

namespace atrium::pdf::drawing_test {
namespace {

namespace fs = std::filesystem;

/// Beside the plugins of the build.
const fs::path plugins = fs::path(ATRIUM_PROGRAM).parent_path().parent_path() / "lib/atrium";
const fs::path program = plugins / "atrium-pdf-draw";

DrawingReply drawn(const DrawingRequest& request) {
  Context context{1, std::make_shared<floorplan::Host>()};
  return reply_from(run_helper_process({"atrium-pdf-draw", program, 0, 0, {}, {}}, to_bytes(request), context).bytes);
}

TEST(Drawing, MessagesAreReadAsTheyWereWritten) {
  const DrawingRequest request{
      "Küche: 1", {"a", "", std::string("\0:12:", 5)}, {{"<svg/>", 297.125, 210}, {"x", 1, 2}}};
  const DrawingRequest read = request_from(to_bytes(request));
  EXPECT_EQ(read.title, request.title);
  EXPECT_EQ(read.texts, request.texts);
  ASSERT_EQ(read.pages.size(), 2U);
  EXPECT_EQ(read.pages[0].svg, "<svg/>");
  EXPECT_EQ(read.pages[0].width, 297.125);
  EXPECT_EQ(read.pages[1].height, 2);
  const std::string bytes = to_bytes(DrawingReply{"p", "h", {"b"}, "%PDF"});
  EXPECT_EQ(reply_from(bytes).file, "%PDF");
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(reply_from(bytes.substr(0, size)), std::runtime_error) << size;
}

TEST(Drawing, TheProgramDrawsAndSaysWhatItCannot) {
  const DrawingReply reply = drawn({"T", {"N 0"}, {{"<svg xmlns='http://www.w3.org/2000/svg'/>", 297, 210}}});
  EXPECT_TRUE(reply.problem.empty()) << reply.problem;
  EXPECT_TRUE(reply.file.starts_with("%PDF-"));
  EXPECT_NE(reply.file.find("/MediaBox"), std::string::npos);
  EXPECT_EQ(drawn({"T", {}, {{"no svg", 297, 210}}}).problem.substr(0, 26), "the sheet cannot be drawn:");
}

/// A run whose program that draws is another one: plugins are found by their folder.
class OtherProgram : public testing::Test {
 protected:
  test::TemporaryFolder folder;
  void SetUp() override {
    fs::create_directories(folder / "plugins");
    for (const auto& entry : fs::directory_iterator(plugins))
      if (entry.path().filename() != program.filename() && entry.path().filename() != "libatrium_pdf.so")
        fs::create_symlink(entry.path(), folder / "plugins" / entry.path().filename());
    fs::copy_file(plugins / "libatrium_pdf.so", folder / "plugins/libatrium_pdf.so");
    // The plan of one triangle of furniture is empty, and drawn.
    test::write_text(folder / "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng object\nf 1 2 3\n");
    test::write_text(folder / "p.yaml", R"(atrium: 1
nodes:
  mesh: {type: io.read_mesh, params: {path: mesh.obj}}
  plan: {type: floorplan.project, in: {mesh: mesh.mesh}}
  draw: {type: pdf.write_plan, in: {plan: plan.plan}}
)");
  }
  test::ProcessResult run_with(const std::string& script) {
    if (!script.empty()) {
      test::write_text(folder / "plugins/atrium-pdf-draw", script);
      fs::permissions(folder / "plugins/atrium-pdf-draw", fs::perms::owner_all);
    }
    test::ProcessOptions options;
    options.folder = folder.path();
    options.environment = {"ATRIUM_PLUGIN_PATH=" + (folder / "plugins").string()};
    auto result =
        test::run_process({ATRIUM_PROGRAM, "run", "p.yaml", "--out", "out", "--no-cache", "--quiet"}, options);
    EXPECT_FALSE(fs::exists(folder / "out/floorplan.pdf"));
    for (const auto& entry : fs::recursive_directory_iterator(folder / "out"))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    return result;
  }
};

TEST_F(OtherProgram, ThatIsEndedBySignalIsAnErrorOfTheNode) {
  const auto result = run_with(
      "#!/bin/sh\ncat > /dev/null\nprintf '%s' 12:half >&1\necho 'GLib: failed to allocate 12 bytes' >&2\nkill -TRAP "
      "$$\n");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("draw (pdf.write_plan): atrium-pdf-draw was ended by the signal"), std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("help: the last that it printed: GLib: failed to allocate 12 bytes"), std::string::npos)
      << result.err;
}

TEST_F(OtherProgram, ThatEndsEarlyIsAnErrorOfTheNode) {
  EXPECT_NE(run_with("#!/bin/sh\necho no >&2\nexit 3\n").err.find("atrium-pdf-draw ended with 3"), std::string::npos);
  EXPECT_NE(run_with("#!/bin/sh\nprintf '%s' 12:half\n").err.find("atrium-pdf-draw gave no reply that can be read"),
            std::string::npos);
}

TEST_F(OtherProgram, ThatIsLackingIsAnErrorOfTheNode) {
  const auto result = run_with("");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("the program atrium-pdf-draw that draws is lacking (looked for "), std::string::npos)
      << result.err;
}

}  // namespace
}  // namespace atrium::pdf::drawing_test
