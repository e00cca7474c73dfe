// The manual page and the completion of bash, which the program prints from the tables of its command line.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test::generate_test {
namespace {

using Words = std::vector<std::string>;

ProcessResult run(Words command) { return run_process(command); }
std::string generated(const std::string& what) {
  const auto result = run({ATRIUM_PROGRAM, "generate", what});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return result.out;
}
Words lines(const std::string& text) {
  Words result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}
bool has(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

class Completion : public testing::Test {
 protected:
  Completion() {
    write_text(folder / "atrium.bash",
               read_text(ATRIUM_SOURCE_DIR "/share/packages/completion.bash") + generated("bash-completion"));
  }

  /// What bash offers behind `atrium WORDS…`; the last word is the one that is being written. bash takes "=" for a
  /// word.
  Words offered(const Words& words) {
    std::string script = "source ./atrium.bash; COMP_WORDS=('" ATRIUM_PROGRAM "'";
    for (const auto& word : words) script += " '" + word + "'";
    script += "); COMP_CWORD=" + std::to_string(words.size()) +
              "; _atrium '" ATRIUM_PROGRAM "'; [[ ${#COMPREPLY[@]} -eq 0 ]] || printf '%s\\n' \"${COMPREPLY[@]}\"";
    ProcessOptions options;
    options.folder = folder.path();
    const auto result = run_process({"bash", "--norc", "-uc", script}, options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return lines(result.out);
  }

  TemporaryFolder folder;
};

TEST_F(Completion, OfCommands) {
  EXPECT_EQ(offered({"ru"}), Words{"run"});
  EXPECT_EQ(offered({"s"}), (Words{"sweep", "schema"}));
  EXPECT_EQ(offered({"sweep", "g"}), Words{"gather"});
  EXPECT_TRUE(has(offered({""}), "nodes"));
  EXPECT_FALSE(has(offered({""}), "generate")) << "it is hidden";
  EXPECT_EQ(offered({"run", "ru"}), Words{}) << "a command stands first only";
}

TEST_F(Completion, OfOptions) {
  EXPECT_EQ(offered({"run", "--no-c"}), Words{"--no-cache"});
  EXPECT_EQ(offered({"run", "x.yaml", "-s", "a", "=", "b", "--ou"}), Words{"--out"});
  EXPECT_EQ(offered({"sweep", "run", "--iso"}), Words{"--isolate"});
  EXPECT_EQ(offered({"nodes", "--iso"}), Words{});
  EXPECT_EQ(offered({"--vers"}), Words{"--version"});
}

TEST_F(Completion, OfTheValuesOfOptions) {
  EXPECT_EQ(offered({"graph", "--format", "m"}), Words{"mermaid"});
  EXPECT_EQ(offered({"graph", "--format", "=", "m"}), Words{"mermaid"});
  EXPECT_EQ(offered({"graph", "--format", "="}), (Words{"dot", "mermaid"}));
  std::filesystem::create_directory(folder / "two words");
  write_text(folder / "two.ply", "");
  EXPECT_EQ(offered({"run", "--out", "two"}), Words{"two words"}) << "folders only";
  EXPECT_EQ(offered({"run", "-j", ""}), Words{}) << "a number";
}

TEST_F(Completion, OfSettings) {
  write_text(folder / "scan.ply", "");
  EXPECT_EQ(offered({"run", "atrium.yaml", "-s", "scan", "=", "sc"}), Words{"scan.ply"});
  EXPECT_TRUE(has(offered({"run", "atrium.yaml", "-s", "scan", "="}), "scan.ply"));
  EXPECT_TRUE(has(offered({"run", "stages.yaml", "-s", "model.pipeline", "=", "atr"}), "atrium.yaml"));
  EXPECT_EQ(offered({"run", "paper.yaml", "-s", "a.type", "=", "align.z"}), Words{"align.z_axis"});
}

TEST_F(Completion, OfPipelinesFilesFoldersAndNodeTypes) {
  write_text(folder / "atrium.yaml", "");
  write_text(folder / "mine.yaml", "");
  EXPECT_TRUE(has(offered({"run", "mi"}), "mine.yaml"));
  EXPECT_TRUE(has(offered({"run", "pap"}), "paper.yaml"));
  EXPECT_TRUE(has(offered({"sweep", "run", "ablations/st"}), "ablations/steps.yaml"));
  EXPECT_EQ(offered({"nodes", "align.z"}), Words{"align.z_axis"});
  std::filesystem::create_directories(folder / "runs");
  EXPECT_EQ(offered({"report", "ru"}), Words{"runs"});
  EXPECT_EQ(offered({"diff", "runs", "ru"}), Words{"runs"});
  EXPECT_EQ(offered({"diff", "runs", "runs", "ru"}), Words{}) << "it takes two";
}

TEST(ManualPage, HasEveryCommandAndOptionOfTheHelp) {
  const std::string page = generated("man");
  std::string plain;
  for (std::size_t i = 0; i < page.size(); ++i) {
    if (page.compare(i, 2, "\\-") == 0) continue;  // a minus sign: the '-' follows
    if (page.compare(i, 2, "\\f") == 0)
      i += 2;
    else
      plain += page[i];
  }
  for (const Words& command :
       {Words{"run"}, Words{"check"}, Words{"nodes"}, Words{"sweep", "plan"}, Words{"sweep", "run"},
        Words{"sweep", "submit"}, Words{"sweep", "gather"}, Words{"diff"}, Words{"graph"}, Words{"report"},
        Words{"schema"}, Words{"cache", "stat"}, Words{"cache", "gc"}, Words{"cache", "verify"}, Words{"why"}}) {
    Words words{ATRIUM_PROGRAM};
    words.insert(words.end(), command.begin(), command.end());
    std::string title = ".SS \"atrium";
    for (const auto& word : command) title += " " + word;
    const std::size_t begin = plain.find(title + "\"\n");
    ASSERT_NE(begin, std::string::npos) << title;
    const std::string section = plain.substr(begin, plain.find("\n.S", begin + 1) - begin);
    words.emplace_back("--help");
    std::size_t options = 0;
    for (const auto& line : lines(run(words).out)) {
      if (!line.starts_with("  -") || line.find("--help") != std::string::npos) continue;
      const std::string name = line.substr(2, line.find_first_of(", ", 2) - 2);
      EXPECT_NE(section.find(name), std::string::npos) << title << ": " << name;
      ++options;
    }
    if (command.front() == "run") {
      EXPECT_GT(options, 5U);
    }
  }
}

TEST(ManualPage, IsSetWithoutWarnings) {
  const TemporaryFolder folder;
  write_text(folder / "atrium.1", generated("man"));
  if (run({"sh", "-c", "command -v groff"}).exit_code == 0) {
    const auto set =
        run({"groff", "-man", "-Tutf8", "-Kutf8", "-P-cbou", "-ww", "-rLL=78n", (folder / "atrium.1").string()});
    EXPECT_EQ(set.exit_code, 0);
    EXPECT_EQ(set.err, "");
    EXPECT_NE(set.out.find("EXIT STATUS"), std::string::npos);
  }
  if (run({"sh", "-c", "command -v mandoc"}).exit_code == 0) {
    // The page has no date: the same source gives the same bytes.
    const auto lint = run({"mandoc", "-T", "lint", "-W", "warning", (folder / "atrium.1").string()});
    for (const auto& line : lines(lint.out)) EXPECT_NE(line.find("missing date"), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace atrium::test::generate_test
