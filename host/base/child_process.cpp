#include "base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "base/elapsed.h"
#include "base/files.h"
#include "gloam/error.h"

extern char** environ;

namespace gloam {
namespace {

/// Both ends of a pipe; the destructor closes them, and other children do not inherit them.
struct Pipe {
  int from = -1, to = -1;
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw Error("cannot open a pipe to a child process: {}", std::strerror(errno));
    from = ends[0], to = ends[1];
    fcntl(from, F_SETFL, O_NONBLOCK);
  }
  ~Pipe() {
    close_end(from);
    close_end(to);
  }
  Pipe(const Pipe&) = delete;
  static void close_end(int& end) {
    if (end >= 0) close(end);
    end = -1;
  }

  /// Reads what there is, up to the end, where it closes `from`.
  void read_more(std::string& text) {
    std::array<char, 4096> buffer;
    for (ssize_t count; from >= 0 && (count = read(from, buffer.data(), buffer.size())) != 0;) {
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && errno == EAGAIN) return;
      if (count < 0) break;
      text.append(buffer.data(), size_t(count));
    }
    close_end(from);
  }
};

/// This process's environment with changes, as "NAME=value".
std::vector<std::string> environment_with(const std::map<std::string, std::string>& changes) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    if (changes.count(text.substr(0, text.find('='))) == 0) all.push_back(text);
  }
  for (const auto& [name, value] : changes) all.push_back(name + "=" + value);
  return all;
}

/// Pointers to texts, and a null pointer at the end.
std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

pid_t spawn(const std::vector<std::string>& arguments, const std::map<std::string, std::string>& changes,
            const Pipe& out, const Pipe& err) {
  std::vector<char*> argv = pointers_to(arguments);
  argv.insert(argv.begin(), const_cast<char*>("gloam"));
  const std::vector<std::string> environment = environment_with(changes);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out.to, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.to, STDERR_FILENO);
  pid_t child = 0;
  const int failed =
      posix_spawn(&child, "/proc/self/exe", &actions, nullptr, argv.data(), pointers_to(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed) throw Error("cannot start a child process: {}", std::strerror(failed));
  return child;
}

/// A group of processes, killed at the end of its life at the latest.
class Group {
 public:
  /// Signals wait until gloam's handler knows the group.
  Group(const std::vector<std::string>& words, const Pipe& out, const Pipe& err) {
    std::vector<char*> argv = pointers_to(words);
    sigset_t all, before, ignored;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    sigemptyset(&ignored);
    sigaddset(&ignored, SIGXFSZ);
    sigaddset(&ignored, SIGPIPE);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setsigmask(&attributes, &before);
    posix_spawnattr_setsigdefault(&attributes, &ignored);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out.to, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err.to, STDERR_FILENO);
    const int failed = posix_spawnp(&leader_, argv[0], &actions, &attributes, argv.data(), environ);
    if (!failed) kill_group_on_signal(leader_);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    if (failed) throw Error("'{}' cannot be started: {}", words.front(), std::strerror(failed));
  }
  ~Group() {
    if (!is_reaped_) status();
  }
  Group(const Group&) = delete;

  pid_t leader() const { return leader_; }
  void end_all() const { kill(-leader_, SIGKILL); }
  /// Ends all, and waits for the leader.
  int status() {
    end_all();  // what a leader that has ended left running
    int status = 0;
    while (waitpid(leader_, &status, 0) < 0 && errno == EINTR) continue;
    kill_group_on_signal(0);
    is_reaped_ = true;
    return status;
  }

 private:
  pid_t leader_ = 0;
  bool is_reaped_ = false;
};

/// Passes complete lines on, and keeps the rest.
void take_lines(std::string& text, const std::function<void(const std::string&)>& line) {
  size_t start = 0;
  for (size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', start)) {
    line(text.substr(start, end - start));
    start = end + 1;
  }
  text.erase(0, start);
}

/// "signal 11 (Segmentation fault)"; empty where it exited.
std::string signal_in_words(int status) {
  return WIFSIGNALED(status) ? fmt::format("signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status))) : "";
}

/// Keeps the end of what a program prints.
void keep_end(std::string& text) {
  constexpr size_t most = 16384;
  if (text.size() > 2 * most) text.erase(0, text.size() - most);
}

std::string last_line(const std::string& text) {
  const size_t end = text.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return "";
  const size_t before = text.find_last_of("\r\n", end);
  return text.substr(before == std::string::npos ? 0 : before + 1).substr(0, end - before);
}

}  // namespace

std::string last_line_of(const ChildEnd& end) {
  const std::string said = last_line(end.said);
  return said.starts_with("gloam: ") ? said.substr(7) : said;
}

void say_to_parent(const nlohmann::ordered_json& line) {
  fmt::print("\n{}\n", line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  std::fflush(stdout);
}

void end_with_parent() { prctl(PR_SET_PDEATHSIG, SIGTERM); }

ChildEnd run_child(const std::vector<std::string>& arguments, double patience,
                   const std::function<void(const std::string&)>& line,
                   const std::map<std::string, std::string>& changes) {
  Pipe out, err;
  const pid_t child = spawn(arguments, changes, out, err);
  Pipe::close_end(out.to);
  Pipe::close_end(err.to);
  std::string text;
  ChildEnd end;
  while (out.from >= 0 || err.from >= 0) {
    std::array<pollfd, 2> ends = {pollfd{out.from, POLLIN, 0}, {err.from, POLLIN, 0}};
    const int ready = poll(ends.data(), ends.size(), int(patience * 1000));
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) {
      end.ended_by = fmt::format("no sign of life for {:g} s", patience);
      kill(child, SIGKILL);
      break;
    }
    out.read_more(text);
    err.read_more(end.said);
    take_lines(text, line);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (end.ended_by.empty()) end.ended_by = signal_in_words(status);
  end.status = end.ended_by.empty() ? WEXITSTATUS(status) : -1;
  return end;
}

std::string in_words(const ForeignEnd& end) {
  if (end.why.empty()) return "";
  return end.said.empty() ? end.why : end.why + ": " + end.said;
}

ForeignEnd run_foreign(const std::vector<std::string>& words, double timeout) {
  constexpr size_t longest_line = 300;
  Pipe out, err;
  std::string printed, said;
  const auto start = std::chrono::steady_clock::now();
  Group group(words, out, err);
  Pipe::close_end(out.to);
  Pipe::close_end(err.to);
  const int ended = int(syscall(SYS_pidfd_open, group.leader(), 0));
  if (ended < 0) throw Error("cannot wait for a child process: {}", std::strerror(errno));
  const auto read_more = [&] {
    out.read_more(printed);
    err.read_more(said);
    keep_end(printed);
    keep_end(said);
  };
  bool is_late = false, has_ended = false;
  while (!has_ended) {
    const double left = timeout - seconds_since(start);
    if (left <= 0 && !is_late) {
      is_late = true;
      group.end_all();
    }
    std::array<pollfd, 3> ends = {pollfd{ended, POLLIN, 0}, {out.from, POLLIN, 0}, {err.from, POLLIN, 0}};
    if (poll(ends.data(), ends.size(), is_late ? -1 : int(std::min(left * 1000 + 1, 1e9))) < 0 && errno != EINTR) break;
    read_more();
    has_ended = ends[0].revents != 0;
  }
  ForeignEnd end;
  end.ms = 1000 * seconds_since(start);
  const int status = group.status();
  close(ended);
  read_more();
  end.status = WIFEXITED(status) && !is_late ? WEXITSTATUS(status) : -1;
  end.why = is_late ? fmt::format("still running after {:g} s", timeout) : signal_in_words(status);
  if (end.why.empty() && end.status != 0) end.why = fmt::format("exit status {}", end.status);
  end.said = last_line(last_line(said).empty() ? printed : said).substr(0, longest_line);
  return end;
}

}  // namespace gloam
