#include "support/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <regex>
#include <stdexcept>
#include <thread>

#include "support/safety_net.h"

namespace test_support {

constexpr std::chrono::milliseconds kPollPeriod{5};

// More than a test program has open at the same time.
constexpr int kMostDescriptors = 1024;

Process::Process(const std::vector<std::string>& command, const std::map<std::string, std::string>& environment)
    : output_(::memfd_create("output", MFD_CLOEXEC)) {
  std::vector<std::string> words = {"env"};
  // Otherwise the output of ROS_INFO and Python is written only when the process ends.
  words.insert(words.end(), {"ROSCONSOLE_STDOUT_LINE_BUFFERED=1", "PYTHONUNBUFFERED=1"});
  for (const auto& [name, value] : environment) {
    words.push_back(name + "=" + value);
  }
  words.insert(words.end(), command.begin(), command.end());
  // Between fork and exec nothing may allocate: another thread may hold the allocator's lock.
  std::vector<char*> arguments;
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  pid_ = ::fork();
  if (pid_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::dup2(output_.get(), STDOUT_FILENO);
    ::dup2(output_.get(), STDERR_FILENO);
    for (int descriptor = STDERR_FILENO + 1; descriptor < kMostDescriptors; ++descriptor) {
      ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);  // the child must not inherit roscpp's sockets
    }
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
}

std::vector<std::string> Process::waitForOutput(const std::string& pattern) {
  const std::regex expression(pattern);
  std::string text;
  std::smatch match;
  const auto matches = [&] {
    text = output();
    return std::regex_search(text, match, expression);
  };
  if (!eventually(matches, kPollPeriod)) {
    throw std::runtime_error("'" + pattern + "' is not in the output:\n" + text);
  }
  return {match.begin(), match.end()};
}

std::string Process::output() const {
  struct stat status = {};
  ::fstat(output_.get(), &status);
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  const ssize_t size = ::pread(output_.get(), text.data(), text.size(), 0);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  return text;
}

void Process::signal(int number) const {
  ::kill(pid_, number);
  siginfo_t stopped = {};
  eventually([&] {  // on a busy computer, its threads go on for a while
    return number != SIGSTOP || ::waitid(P_PID, static_cast<id_t>(pid_), &stopped, WSTOPPED | WNOHANG) != 0 ||
           stopped.si_pid != 0;
  });
}

void Process::kill() {
  if (!exit_status_) {
    ::kill(pid_, SIGKILL);
    waitForExit(std::chrono::hours(1));
  }
}

std::optional<int> Process::waitForExit(std::chrono::milliseconds timeout) {
  const auto end = std::chrono::steady_clock::now() + timeout;
  while (!exit_status_) {
    int status = 0;
    if (::waitpid(pid_, &status, WNOHANG) == pid_) {
      exit_status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    } else if (std::chrono::steady_clock::now() >= end) {
      break;
    } else {
      std::this_thread::sleep_for(kPollPeriod);
    }
  }
  return exit_status_;
}

}  // namespace test_support
