#include "support/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <regex>
#include <stdexcept>

#include "support/safety_net.h"

namespace test_support {
namespace {

constexpr std::chrono::milliseconds kPollPeriod{5};

// What a process has printed is read at once when it ends, unless a child of its own goes on.
constexpr std::chrono::seconds kLastOutput{1};

// More than a test program has open at the same time.
constexpr int kMostDescriptors = 1024;

}  // namespace

Process::Process(const std::vector<std::string>& command, const std::map<std::string, std::string>& environment) {
  std::vector<std::string> words = {"env"};
  // Otherwise the output of ROS_INFO and Python reaches a pipe only when the process ends.
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
  std::array<int, 2> pipe_ends{};
  if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error("no pipe");
  }
  pid_ = ::fork();
  if (pid_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::dup2(pipe_ends[1], STDOUT_FILENO);
    ::dup2(pipe_ends[1], STDERR_FILENO);
    for (int descriptor = STDERR_FILENO + 1; descriptor < kMostDescriptors; ++descriptor) {
      ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);  // the child must not inherit roscpp's sockets
    }
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  ::close(pipe_ends[1]);
  output_descriptor_ = pipe_ends[0];
  reader_ = std::thread(&Process::readOutput, this);
}

Process::~Process() {
  kill();
  reader_.join();
  ::close(output_descriptor_);
}

std::vector<std::string> Process::waitForOutput(const std::string& pattern, std::chrono::seconds timeout) {
  const std::regex expression(pattern);
  std::smatch match;
  std::unique_lock<std::mutex> lock(mutex_);
  if (!changed_.wait_for(lock, timeout, [&] { return std::regex_search(output_, match, expression); })) {
    throw std::runtime_error("'" + pattern + "' is not in the output:\n" + output_);
  }
  return {match.begin(), match.end()};
}

std::string Process::output() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return output_;
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
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, kLastOutput, [&] { return !exit_status_ || output_complete_; });
  return exit_status_;
}

void Process::readOutput() {
  std::array<char, 4096> buffer{};
  ssize_t count = 0;
  while ((count = ::read(output_descriptor_, buffer.data(), buffer.size())) > 0) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      output_.append(buffer.data(), static_cast<std::size_t>(count));
    }
    changed_.notify_all();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  output_complete_ = true;
  changed_.notify_all();
}

}  // namespace test_support
