#include "cli/process/browser.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <string>

namespace gloam::cli {
namespace {

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

bool is_in_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace

bool has_browser() {
  return isatty(STDOUT_FILENO) && (is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")) && is_in_path("xdg-open");
}

void open_in_browser(const std::filesystem::path& page) {
  const std::string path = std::filesystem::absolute(page).string();
  const pid_t child = fork();
  if (child > 0) waitpid(child, nullptr, 0);  // the first child ends at once
  if (child != 0) return;
  setsid();
  if (fork() != 0) _exit(0);
  const int nothing = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, stream);
  execlp("xdg-open", "xdg-open", path.c_str(), nullptr);
  _exit(127);
}

}  // namespace gloam::cli
