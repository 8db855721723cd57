#include "cli/process/children.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "gloam/error.h"

extern char** environ;

namespace gloam::cli {
namespace {

/// Both ends of a pipe; the destructor closes them, and other children do not inherit them.
struct Pipe {
  int from = -1, to = -1;
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw Error("cannot open a pipe to a child process: {}", std::strerror(errno));
    from = ends[0], to = ends[1];
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

/// Passes complete lines on, and keeps the rest.
void take_lines(std::string& text, const std::function<void(const std::string&)>& line) {
  size_t start = 0;
  for (size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', start)) {
    line(text.substr(start, end - start));
    start = end + 1;
  }
  text.erase(0, start);
}

/// Reads more of a pipe; false at its end.
bool read_more(int end, std::string& text) {
  std::array<char, 4096> buffer;
  const ssize_t count = read(end, buffer.data(), buffer.size());
  if (count > 0) text.append(buffer.data(), size_t(count));
  return count > 0 || (count < 0 && errno == EINTR);
}

ChildEnd ended(pid_t child, bool was_killed, double patience) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (was_killed) return {-1, fmt::format("no sign of life for {:g} s", patience), ""};
  if (WIFSIGNALED(status))
    return {-1, fmt::format("signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status))), ""};
  return {WEXITSTATUS(status), "", ""};
}

}  // namespace

std::string last_line_of(const ChildEnd& end) {
  std::string said = end.said;
  while (!said.empty() && said.back() == '\n') said.pop_back();
  said.erase(0, said.rfind('\n') + 1);
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
  std::string text, said;
  bool is_open = true, is_said = true, was_killed = false;
  while (is_open || is_said) {
    std::array<pollfd, 2> ends = {pollfd{is_open ? out.from : -1, POLLIN, 0}, {is_said ? err.from : -1, POLLIN, 0}};
    const int ready = poll(ends.data(), ends.size(), int(patience * 1000));
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) {
      was_killed = true;
      kill(child, SIGKILL);
      break;
    }
    if (ends[0].revents) is_open = read_more(out.from, text);
    if (ends[1].revents) is_said = read_more(err.from, said);
    take_lines(text, line);
  }
  ChildEnd end = ended(child, was_killed, patience);
  end.said = said;
  return end;
}

}  // namespace gloam::cli
