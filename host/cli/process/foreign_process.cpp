#include "cli/process/foreign_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "base/elapsed.h"
#include "base/files.h"
#include "base/lists.h"
#include "gloam/error.h"

extern char** environ;

namespace gloam::cli {
namespace {

/// The end of what a program prints.
class Tail {
 public:
  Tail() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw Error("cannot open a pipe to a child process: {}", std::strerror(errno));
    from_ = ends[0], to_ = ends[1];
    fcntl(from_, F_SETFL, O_NONBLOCK);
  }
  ~Tail() {
    close_end(from_);
    close_end(to_);
  }
  Tail(const Tail&) = delete;

  int from() const { return from_; }
  int to() const { return to_; }
  void close_writing() { close_end(to_); }

  /// Reads what there is.
  void read_more() {
    std::array<char, 4096> buffer;
    for (ssize_t count; from_ >= 0 && (count = read(from_, buffer.data(), buffer.size())) != 0;) {
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && errno == EAGAIN) return;
      if (count < 0) break;
      text_.append(buffer.data(), size_t(count));
      if (text_.size() > 2 * most) text_.erase(0, text_.size() - most);
    }
    close_end(from_);
  }

  std::string last_line() const {
    const size_t end = text_.find_last_not_of(" \t\r\n");
    if (end == std::string::npos) return "";
    const size_t before = text_.find_last_of("\r\n", end);
    const size_t begin = before == std::string::npos ? 0 : before + 1;
    return text_.substr(begin, std::min<size_t>(end + 1 - begin, 300));
  }

 private:
  static constexpr size_t most = 16384;
  static void close_end(int& end) {
    if (end >= 0) close(end);
    end = -1;
  }
  int from_ = -1, to_ = -1;
  std::string text_;
};

/// A group of processes, killed at the end of its life at the latest.
class Group {
 public:
  /// Signals wait until gloam's handler knows the group.
  Group(const std::vector<std::string>& words, const Tail& out, const Tail& err) {
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
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
    posix_spawn_file_actions_adddup2(&actions, out.to(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err.to(), STDERR_FILENO);
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

std::string words_for(int status) {
  if (WIFSIGNALED(status)) return fmt::format("signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  return WEXITSTATUS(status) == 0 ? "" : fmt::format("exit status {}", WEXITSTATUS(status));
}

}  // namespace

std::string in_words(const ForeignEnd& end) {
  if (end.why.empty()) return "";
  return end.said.empty() ? end.why : end.why + ": " + end.said;
}

ForeignEnd run_foreign(const std::vector<std::string>& words, double timeout) {
  Tail out, err;
  const auto start = std::chrono::steady_clock::now();
  Group group(words, out, err);
  out.close_writing();
  err.close_writing();
  const int ended = int(syscall(SYS_pidfd_open, group.leader(), 0));
  if (ended < 0) throw Error("cannot wait for a child process: {}", std::strerror(errno));
  bool is_late = false, has_ended = false;
  while (!has_ended) {
    const double left = timeout - seconds_since(start);
    if (left <= 0 && !is_late) {
      is_late = true;
      group.end_all();
    }
    std::array<pollfd, 3> ends = {pollfd{ended, POLLIN, 0}, {out.from(), POLLIN, 0}, {err.from(), POLLIN, 0}};
    if (poll(ends.data(), ends.size(), is_late ? -1 : int(std::min(left * 1000 + 1, 1e9))) < 0 && errno != EINTR) break;
    out.read_more();
    err.read_more();
    has_ended = ends[0].revents != 0;
  }
  ForeignEnd end;
  end.ms = 1000 * seconds_since(start);
  const int status = group.status();
  close(ended);
  out.read_more();
  err.read_more();
  end.status = WIFEXITED(status) && !is_late ? WEXITSTATUS(status) : -1;
  end.why = is_late ? fmt::format("still running after {:g} s", timeout) : words_for(status);
  end.said = err.last_line().empty() ? out.last_line() : err.last_line();
  return end;
}

std::vector<std::string> words_of_command(const std::string& command, const std::string& flag) {
  static const std::vector<std::string> operators = {"|", "||", "&", "&&", ";", ">", ">>", "<", "2>", "2>&1"};
  std::vector<std::string> words;
  std::string word;
  bool is_in_word = false;
  char quote = 0;
  for (size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
      if (is_in_word) words.push_back(word);
      word.clear();
      is_in_word = false;
      continue;
    }
    is_in_word = true;
    if (c == '\\' && quote != '\'' && i + 1 < command.size())
      word += command[++i];
    else if (quote == 0 && (c == '\'' || c == '"'))
      quote = c;
    else if (c == quote)
      quote = 0;
    else
      word += c;
  }
  if (quote != 0) throw UsageError("{} {}: the quote {} has no end", flag, command, quote);
  if (is_in_word) words.push_back(word);
  if (words.empty()) throw UsageError("{}: is empty; write 'engine --in {{frame}} --out {{image}}'", flag);
  for (const std::string& each : words) {
    if (contains(operators, each))
      throw UsageError("{} {}: '{}' is for a shell, and gloam starts none; write sh -c '...'", flag, command, each);
  }
  return words;
}

std::string with_values(const std::string& word, const std::map<std::string, std::string>& values,
                        const std::string& flag) {
  std::string out;
  for (size_t i = 0; i < word.size(); ++i) {
    const bool is_double = i + 1 < word.size() && word[i + 1] == word[i] && (word[i] == '{' || word[i] == '}');
    const size_t end = word[i] == '{' && !is_double ? word.find('}', i) : std::string::npos;
    if (is_double) {
      out += word[i++];
    } else if (end != std::string::npos) {
      const std::string name = word.substr(i + 1, end - i - 1);
      std::vector<std::string> known;
      for (const auto& [each, value] : values) known.push_back("{" + each + "}");
      const auto found = values.find(name);
      if (found == values.end())
        throw UsageError("{}: {{{}}} stands for nothing{}; {} are allowed, and {{{{ for a brace", flag, name,
                         suggestion("{" + name + "}", known), enumerate(known));
      out += found->second;
      i = end;
    } else {
      out += word[i];
    }
  }
  return out;
}

}  // namespace gloam::cli
