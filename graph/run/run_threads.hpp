#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace atrium {

/// The threads that nodes and their loops share: the one that calls execute(), and helpers that take part in whatever
/// is spawned there. They are made here, not by oneTBB: where the system refuses a thread (ulimit -u, a container's
/// limit of processes, a small address space), oneTBB's own ends the program.
class RunThreads {
 public:
  /// So many, or fewer if the system refuses. Then half of those that could be had are left to others: the cache's
  /// writer, libraries, other processes of the user.
  explicit RunThreads(int wanted);
  ~RunThreads();
  RunThreads(const RunThreads&) = delete;
  RunThreads& operator=(const RunThreads&) = delete;

  int number() const;
  /// What the user should know if there are fewer than wanted; otherwise empty.
  const std::string& shortage() const { return shortage_; }
  /// Calls work here; oneTBB's tasks that it spawns run on all of the threads. Throws what work throws.
  void execute(const std::function<void()>& work);

 private:
  struct Arena;
  class Helper;
  void start_helpers(int wanted);

  std::unique_ptr<Arena> arena_;
  std::vector<std::unique_ptr<Helper>> helpers_;
  std::string shortage_;
};

}  // namespace atrium
