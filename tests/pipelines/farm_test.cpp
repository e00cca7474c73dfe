// `atrium sweep submit` and `gather`: many machines. Slurm and GNU parallel are the real ones where they are installed.
#include <arpa/inet.h>
#include <pwd.h>
#include <sys/prctl.h>
#include <sys/socket.h>

#include <csignal>
#include <thread>

#include "tests/pipelines/sweep_folder_test.hpp"
#include "tests/support/lacking.hpp"

namespace atrium::test::farm_test {
namespace {

/// Whether a condition comes true within so many seconds.
bool comes_true(double seconds, const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

/// A program in the background, which ends with this object or with the test.
class Background {
 public:
  Background(std::vector<std::string> command, const fs::path& folder, const fs::path& log,
             std::vector<std::string> environment = {}) {
    process_ = ::fork();
    if (process_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
    ProcessOptions options;
    options.folder = folder;
    options.environment = std::move(environment);
    detail::become(command, options, file, file);
  }
  ~Background() { end(SIGTERM); }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;
  pid_t id() const { return process_; }
  void end(int signal) {
    if (process_ <= 0) return;
    ::kill(process_, signal);
    int status = 0;
    if (!comes_true(10, [&] { return ::waitpid(process_, &status, WNOHANG) != 0; })) {
      ::kill(process_, SIGKILL);
      ::waitpid(process_, &status, 0);
    }
    process_ = -1;
  }

 private:
  pid_t process_ = -1;
};

int free_port() {
  const int file = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ::bind(file, reinterpret_cast<sockaddr*>(&address), size);
  ::getsockname(file, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(file);
  return ntohs(address.sin_port);
}

/// Slurm with this machine as its only node, with a configuration, ports and a key of its own.
class Slurm {
 public:
  explicit Slurm(const fs::path& folder) : folder_(folder) {
    for (const char* name : {"munge", "state", "spool"}) fs::create_directories(folder_ / name);
    fs::permissions(folder_ / "munge", fs::perms::owner_all);
    std::array<char, 256> host{};
    ::gethostname(host.data(), host.size() - 1);
    host_ = std::string(host.data()).substr(0, std::string(host.data()).find('.'));
    std::string key;
    std::ifstream random("/dev/urandom", std::ios::binary);
    for (int i = 0; i < 1024; ++i) key += static_cast<char>(random.get());
    write_text(folder_ / "munge/key", key);
    fs::permissions(folder_ / "munge/key", fs::perms::owner_read);
    write_configuration();
    const std::string munge = (folder_ / "munge").string();
    munged_ = std::make_unique<Background>(
        std::vector<std::string>{"/usr/sbin/munged", "--foreground", "--force", "--key-file=" + munge + "/key",
                                 "--socket=" + socket(), "--pid-file=" + munge + "/pid", "--log-file=" + munge + "/log",
                                 "--seed-file=" + munge + "/seed"},
        folder_, folder_ / "munged.log");
    comes_true(10, [&] { return fs::exists(socket()); });
    slurmctld_ = start("/usr/sbin/slurmctld");
    slurmd_ = start("/usr/sbin/slurmd");
  }
  ~Slurm() {
    call({"scancel", "--full", "--user", user()});
    comes_true(10, [&] { return queue().empty(); });
  }
  Slurm(const Slurm&) = delete;
  Slurm& operator=(const Slurm&) = delete;

  static bool is_installed() {
    for (const char* name : {"/usr/sbin/munged", "/usr/sbin/slurmctld", "/usr/sbin/slurmd", "/usr/bin/sbatch"})
      if (!fs::exists(name)) return false;
    return true;
  }
  bool comes_up() {
    return comes_true(20, [&] { return call({"sinfo", "-h", "-o", "%T"}).out.starts_with("idle"); });
  }
  std::string queue() { return call({"squeue", "-h", "-r"}).out; }
  std::string environment() const { return "SLURM_CONF=" + (folder_ / "slurm.conf").string(); }
  std::string log() const {
    std::string text;
    for (const char* name : {"munged", "slurmctld", "slurmd"})
      if (const fs::path file = folder_ / (std::string(name) + ".log"); fs::exists(file)) text += read_text(file);
    return text.substr(text.size() - std::min<std::size_t>(text.size(), 3000));
  }

 private:
  static std::string user() { return ::getpwuid(::getuid())->pw_name; }
  std::string socket() const { return (folder_ / "munge/socket").string(); }
  ProcessResult call(const std::vector<std::string>& command) const {
    ProcessOptions options;
    options.environment = {environment()};
    options.timeout = 10;
    return run_process(command, options);
  }
  std::unique_ptr<Background> start(const std::string& daemon) const {
    return std::make_unique<Background>(std::vector<std::string>{daemon, "-D"}, folder_,
                                        folder_ / (fs::path(daemon).filename().string() + ".log"),
                                        std::vector<std::string>{environment()});
  }
  // Containers often lack cgroups, and the node may have fewer cores than the test wants.
  void write_configuration() const {
    const auto file = [&](const char* name) { return (folder_ / name).string() + "\n"; };
    write_text(folder_ / "slurm.conf",
               "ClusterName=atrium\nSlurmctldHost=" + host_ + "(127.0.0.1)\nSlurmUser=" + user() +
                   "\nSlurmdUser=" + user() + "\nSlurmctldPort=" + std::to_string(free_port()) +
                   "\nSlurmdPort=" + std::to_string(free_port()) +
                   "\nAuthType=auth/munge\nCryptoType=crypto/munge\nAuthInfo=socket=" + socket() +
                   "\nStateSaveLocation=" + file("state") + "SlurmdSpoolDir=" + file("spool") +
                   "SlurmctldPidFile=" + file("slurmctld.pid") + "SlurmdPidFile=" + file("slurmd.pid") +
                   "ProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\nJobAcctGatherType=jobacct_gather/none\n"
                   "AccountingStorageType=accounting_storage/none\nJobCompType=jobcomp/none\nMpiDefault=none\n"
                   "SwitchType=switch/none\nSelectType=select/cons_tres\nSelectTypeParameters=CR_CPU\n"
                   "SchedulerType=sched/"
                   "builtin\nSchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0\n"
                   "ReturnToService=2\nMailProg=/bin/true\nKillWait=5\nSlurmdParameters=config_overrides\n"
                   "NodeName=" +
                   host_ +
                   " NodeAddr=127.0.0.1 CPUs=4 Sockets=4 CoresPerSocket=1 ThreadsPerCore=1 "
                   "RealMemory=1000 State=UNKNOWN\nPartitionName=all Nodes=" +
                   host_ + " Default=YES State=UP\n");
  }

  fs::path folder_;
  std::string host_;
  std::unique_ptr<Background> munged_, slurmctld_, slurmd_;
};

class Farm : public SweepFolderTest {
 protected:
  /// 20 variants: one fails, one crashes.
  void twenty() {
    std::string list;
    for (int i = 1; i <= 18; ++i) list += "n" + std::to_string(i) + ": {second.number: " + std::to_string(i) + "}, ";
    sweep("list: {" + list +
          "bad: {random.mode: fail}, worse: {second.mode: segv}}\nmetrics: {sum: sum, random: random}\n");
  }
  /// What gather says of each variant: by label.
  std::map<std::string, std::string> gathered(const std::string& out, int expected_code) {
    const auto result = atrium({"gather", out, "--json"});
    EXPECT_EQ(result.exit_code, expected_code) << result.err;
    std::map<std::string, std::string> found;
    const json all = json::parse(result.out, nullptr, false);
    if (!all.is_object()) return found;
    for (const auto& variant : all.at("variants"))
      found[variant.value("variant", variant.value("second.number", ""))] = variant.at("status");
    return found;
  }
  void expect_truth_of_twenty(const std::string& out) {
    const auto status = gathered(out, 4);
    ASSERT_EQ(status.size(), 20U);
    for (int i = 1; i <= 18; ++i) EXPECT_EQ(status.at("n" + std::to_string(i)), "ok");
    EXPECT_EQ(status.at("bad"), "failed: random: told to fail");
    EXPECT_EQ(status.at("worse"), "crashed: signal 11 (SIGSEGV) in node second");
    // As `sweep run` leaves it.
    ASSERT_EQ(atrium({"run", "s.yaml", "--isolate", "--out", "here", "-q", "--cache", "cache-here"}).exit_code, 4);
    expect_same(left(out), left("here"));
    // What the variants share was computed once.
    const json manifest = json::parse(read_text(folder / out / "manifest.json"));
    for (const auto& node : manifest.at("nodes")) {
      if (node.at("status") != "ok") continue;
      EXPECT_EQ(node.at("cache").at("result"), "miss") << node;
    }
  }
  /// The newest (and only) submission's folder.
  fs::path work(const std::string& out) {
    return folder / out / "farm" /
           json::parse(read_text(folder / out / "farm/submission.json")).at("id").get<std::string>();
  }
  /// A queue that never comes to an end: sbatch takes the jobs, and nobody begins with them.
  ProcessOptions without_machines() {
    fs::create_directories(folder / "bin");
    write_text(folder / "bin/sbatch", "#!/bin/sh\necho \"$@\" >>sbatch.called\necho 17\n");
    fs::permissions(folder / "bin/sbatch", fs::perms::owner_all);
    ProcessOptions options;
    options.environment.push_back("PATH=" + (folder / "bin").string() + ":/usr/bin:/bin");
    return options;
  }
};

TEST_F(Farm, SlurmRunsTwentyVariantsAndGatherTellsTheTruth) {
  if (!Slurm::is_installed()) ATRIUM_SKIP_LACKING("slurmctld, slurmd, slurm-client and munge are not installed");
  Slurm slurm(folder / "slurm");
  if (!slurm.comes_up()) GTEST_SKIP() << "Slurm does not come up on this machine: " << slurm.log();
  twenty();
  ProcessOptions options;
  options.environment.push_back(slurm.environment());
  const auto result = atrium({"submit", "s.yaml", "--engine", "slurm", "--out", "out", "--cache", "cache", "--shards",
                              "6", "--", "--partition=all"},
                             options);
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_NE(result.err.find("20 variants submitted; their table: atrium sweep gather out"), std::string::npos)
      << result.err;
  ASSERT_TRUE(comes_true(60, [&] { return slurm.queue().empty(); })) << slurm.queue() << slurm.log();
  expect_truth_of_twenty("out");
  // What is done is not done again: the two others are, in one shard each.
  const auto again =
      atrium({"submit", "s.yaml", "--engine", "slurm", "--out", "out", "--cache", "cache", "--dry-run"}, options);
  EXPECT_NE(again.out.find(" --array=1-2 "), std::string::npos) << again.out;
}

TEST_F(Farm, GnuParallelRunsTwentyVariantsAndGatherTellsTheTruth) {
  if (!fs::exists("/usr/bin/parallel")) ATRIUM_SKIP_LACKING("parallel is not installed");
  twenty();
  const auto result = atrium({"submit", "s.yaml", "--engine", "parallel", "--out", "out", "--cache", "cache",
                              "--shards", "4", "--", "--sshlogin", "2/:"});
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  expect_truth_of_twenty("out");
}

// No part of a folder's name is a command, nor anything that parallel replaces.
TEST_F(Farm, AnyFolderWillDo) {
  if (!fs::exists("/usr/bin/parallel")) ATRIUM_SKIP_LACKING("parallel is not installed");
  sweep("grid: {second.number: [2, 3]}\nmetrics: {sum: sum}\n");
  for (const std::string out : {"it's here", "a {} b {#} %a %%", "x'; touch INJECTED; echo '", "$(touch INJECTED)"}) {
    const auto result = atrium({"submit", "s.yaml", "--engine", "parallel", "--out", out, "--no-cache"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("2 of 2 variants have a result"), std::string::npos) << result.err;
    EXPECT_EQ(gathered(out, 0).size(), 2U);
    EXPECT_TRUE(fs::exists(work(out) / "shard-2.log"));
  }
  EXPECT_FALSE(fs::exists(folder / "INJECTED"));
  // Nothing runs: that is said.
  write_text(folder / "none", "#!/bin/sh\ncat >/dev/null\nexit 2\n");
  fs::create_directories(folder / "bin");
  fs::rename(folder / "none", folder / "bin/parallel");
  fs::permissions(folder / "bin/parallel", fs::perms::owner_all);
  ProcessOptions options;
  options.environment.push_back("PATH=" + (folder / "bin").string() + ":/usr/bin:/bin");
  const auto nothing = atrium({"submit", "s.yaml", "--engine", "parallel", "--out", "no", "--no-cache"}, options);
  EXPECT_EQ(nothing.exit_code, 1);
  EXPECT_NE(nothing.err.find("0 of 2 variants have a result"), std::string::npos) << nothing.err;
}

TEST_F(Farm, ADryRunPrintsWhatIsCalledAndWritesNothing) {
  sweep("grid: {second.number: [2, 3, 4]}\n");
  const auto result = atrium({"submit", "s.yaml", "--engine", "slurm", "--out", "it's here", "--cache", "cache",
                              "--shards", "2", "-j", "4", "--dry-run", "--", "--time=2:00:00"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* part :
       {"exec ", " sweep work '", "it'\\''s here'", "/\"$1-$SLURM_ARRAY_TASK_ID\" -j \"${SLURM_CPUS_PER_TASK:-1}\"",
        "shared=$(sbatch --parsable --job-name=s-shared --array=1-1 ", "--cpus-per-task=4", " --time=2:00:00 ",
        "sbatch --parsable --job-name=s-shard --array=1-2 ", " --dependency=\"afterany:${shared%%;*}\" "})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
  EXPECT_FALSE(fs::exists(folder / "it's here"));
  const auto parallel = atrium({"submit", "s.yaml", "--engine", "parallel", "--out", "out", "--no-cache", "--dry-run"});
  EXPECT_EQ(parallel.out.find("shared"), std::string::npos) << parallel.out;  // through what?
  EXPECT_NE(parallel.out.find("\nfor task in $(seq 3); do "), std::string::npos) << parallel.out;
  EXPECT_EQ(atrium({"submit", "s.yaml", "--engine", "pbs", "--out", "out"}).exit_code, 2);
}

TEST_F(Farm, GatherTellsWhatIsMissingRunningLostAndCancelled) {
  sweep(
      "list: {a: {}, b: {second.number: 3}, never: {second.mode: hang}, c: {second.number: 4}}\nmetrics: {sum: sum}\n");
  ASSERT_EQ(atrium({"submit", "s.yaml", "--engine", "slurm", "--out", "out", "--cache", "cache", "--shards", "3"},
                   without_machines())
                .exit_code,
            0);
  EXPECT_NE(read_text(folder / "sbatch.called").find("--dependency=afterany:17 "), std::string::npos);
  for (const auto& [label, status] : gathered("out", 4))
    EXPECT_TRUE(status.ends_with(" has not begun")) << label << status;
  const std::string id = work("out").filename().string();
  // a and c in the first shard, b in the second, never in the third.
  ASSERT_EQ(atrium({"work", "out", id + "/shard-1"}).exit_code, 0);
  std::vector<std::string> environment{"ATRIUM_PLUGIN_PATH=" ATRIUM_TRIAL_PLUGIN};
  const auto begin = [&] {
    return std::make_unique<Background>(
        std::vector<std::string>{ATRIUM_PROGRAM, "sweep", "work", "out", id + "/shard-3"}, folder.path(),
        folder / "log", environment);
  };
  const auto hangs = [&] {
    return fs::exists(folder / "log") && read_text(folder / "log").find("hanging") != std::string::npos;
  };
  auto shard = begin();
  ASSERT_TRUE(comes_true(30, hangs));
  auto status = gathered("out", 4);
  EXPECT_EQ(status["a"], "ok");
  EXPECT_EQ(status["c"], "ok");
  EXPECT_EQ(status["b"], "missing: shard-2 has not begun");
  EXPECT_TRUE(status["never"].starts_with("running: in shard-3 (process " + std::to_string(shard->id()) + " on "))
      << status["never"];
  // Nobody else may write into the folder meanwhile.
  EXPECT_EQ(atrium({"run", "s.yaml", "--out", "out"}).exit_code, 2);
  shard->end(SIGKILL);
  fs::last_write_time(work("out") / "shard-3.events", fs::file_time_type::clock::now() - std::chrono::minutes(5));
  status = gathered("out", 4);
  EXPECT_TRUE(status["never"].starts_with("lost: no sign of life of shard-3 (process ")) << status["never"];
  fs::remove(folder / "log");
  shard = begin();
  ASSERT_TRUE(comes_true(30, hangs));
  shard->end(SIGTERM);
  EXPECT_EQ(gathered("out", 4)["never"], "cancelled: shard-3 was ended");
  // A task of an earlier submission is none of the next one.
  ASSERT_EQ(atrium({"submit", "s.yaml", "--engine", "slurm", "--out", "out", "--cache", "cache"}, without_machines())
                .exit_code,
            0);
  const auto stale = atrium({"work", "out", id + "/shard-2"});
  EXPECT_EQ(stale.exit_code, 1);
  EXPECT_NE(stale.err.find("there is no task"), std::string::npos) << stale.err;
  // A shard that cannot begin says why.
  write_text(work("out") / "shard-1.log", "slurmstepd: something\natrium: error: no such file\n  help: none\n");
  EXPECT_EQ(gathered("out", 4)["b"], "missing: shard-1 has not begun: no such file");
  // What was submitted is what is gathered.
  sweep("list: {a: {}, b: {second.number: 5}}\nmetrics: {sum: sum}\n");
  const auto changed = atrium({"gather", "out"});
  EXPECT_EQ(changed.exit_code, 1);
  EXPECT_NE(changed.err.find("does not describe the variants any more that were submitted"), std::string::npos)
      << changed.err;
  EXPECT_EQ(atrium({"gather", "nowhere"}).exit_code, 1);
}

}  // namespace
}  // namespace atrium::test::farm_test
