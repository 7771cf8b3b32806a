/// @file child_process.h
/// A program that a test runs, and its output.
#ifndef TEST_UNIT_RCSERVER_CHILD_PROCESS_H
#define TEST_UNIT_RCSERVER_CHILD_PROCESS_H

#include <poll.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <string>
#include <vector>

class ChildProcess {
 public:
  /// @param arguments the first is the program
  explicit ChildProcess(std::vector<std::string> arguments) {
    int ends[2];
    if (::pipe(ends) != 0) {
      throw std::runtime_error("no pipe");
    }
    std::vector<char*> argv;
    for (std::string& argument : arguments) {
      argv.push_back(argument.data());
    }
    argv.push_back(nullptr);
    process_ = ::fork();
    if (process_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::dup2(ends[1], STDERR_FILENO);
      ::close(ends[0]);
      ::close(ends[1]);
      ::execv(argv[0], argv.data());
      ::_exit(127);
    }
    ::close(ends[1]);
    output_ = ends[0];
  }
  ~ChildProcess() {
    if (!ended_) {
      ::kill(process_, SIGKILL);
      ::waitpid(process_, nullptr, 0);
    }
    ::close(output_);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Reads the output until it has a complete line with `text`, or until the program ends.
  /// @return that line from `text` on; empty if there is none
  std::string readLineWith(const std::string& text) {
    for (;;) {
      const size_t begin = printed_.find(text);
      const size_t end = begin == std::string::npos ? begin : printed_.find('\n', begin);
      if (end != std::string::npos) {
        return printed_.substr(begin, end - begin);
      }
      if (!readSome()) {
        return {};
      }
    }
  }

  void signal(int number) { ::kill(process_, number); }

  /// Reads all output, and waits for the program's end.
  /// @return its exit code; -1 if a signal ended it
  int wait() {
    while (readSome()) {
    }
    int status = 0;
    ::waitpid(process_, &status, 0);
    ended_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  const std::string& printed() const { return printed_; }

 private:
  bool readSome() {
    char bytes[4096];
    pollfd readable{output_, POLLIN, 0};
    if (::poll(&readable, 1, kSafetyNetMilliseconds) != 1) {
      return false;
    }
    const ssize_t size = ::read(output_, bytes, sizeof(bytes));
    if (size > 0) {
      printed_.append(bytes, static_cast<size_t>(size));
    }
    return size > 0;
  }

  static constexpr int kSafetyNetMilliseconds = 30000;

  pid_t process_ = -1;
  int output_ = -1;
  bool ended_ = false;
  std::string printed_;
};

#endif  // TEST_UNIT_RCSERVER_CHILD_PROCESS_H
