#include "sound/source.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>
#include <utility>

#include "files/files.h"
#include "host_files/file_descriptor.h"

namespace aibo_driver::sound {

using aibo_client::InvalidArgumentException;
using files::FileException;
using host_files::FileDescriptor;

namespace {

constexpr std::size_t kLongestText = 4000;
constexpr std::size_t kLongestVoice = 40;
constexpr std::chrono::seconds kLongestTime{20};

// The voice's name becomes an argument of a program that also takes the paths of files, so it is checked.
bool isVoice(const std::string& voice) {
  return voice.size() <= kLongestVoice && std::isalnum(static_cast<unsigned char>(voice.front())) != 0 &&
         std::all_of(voice.begin(), voice.end(), [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '+';
         });
}

/// Starts espeak-ng. It reads the text as standard input, and writes to its descriptor 3.
pid_t start(const FileDescriptor& text, const FileDescriptor& sound, const std::string& voice) {
  constexpr int kSound = 3;
  const char* const words[] = {"espeak-ng", "-v", voice.c_str(), "--stdin", "-w", "/proc/self/fd/3", nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, text.get(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, sound.get(), kSound);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int error = ::posix_spawnp(&process, words[0], &actions, nullptr, const_cast<char* const*>(words), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) {
    throw FileException(
        "espeak-ng, which makes the speech, is not installed on the computer of this program. Install it: sudo apt "
        "install espeak-ng");
  }
  if (error != 0) {
    throw FileException(std::string("espeak-ng cannot be started: ") + std::strerror(error));
  }
  return process;
}

void waitFor(pid_t process, const std::string& voice) {
  const auto deadline = std::chrono::steady_clock::now() + kLongestTime;
  int status = 0;
  while (::waitpid(process, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline) {
      ::kill(process, SIGKILL);
      ::waitpid(process, &status, 0);
      throw FileException("espeak-ng takes longer than " + std::to_string(kLongestTime.count()) + " s");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw FileException("espeak-ng has failed: is there a voice '" + voice + "'? espeak-ng --voices lists them");
  }
}

}  // namespace

Source speak(const std::string& text, const std::string& voice) {
  const std::string chosen = voice.empty() ? "en" : voice;
  if (text.empty() || text.size() > kLongestText) {
    throw InvalidArgumentException(text.empty() ? "give a text"
                                                : "the text has " + std::to_string(text.size()) + " bytes; at most " +
                                                      std::to_string(kLongestText) + " are possible");
  }
  if (!isVoice(chosen)) {
    throw InvalidArgumentException("a voice has a name of letters and digits, such as en or de");
  }
  const FileDescriptor words = files::memoryFile("the text", text);
  FileDescriptor sound = files::memoryFile("speech", "");
  waitFor(start(words, sound, chosen), chosen);
  return readSound(std::move(sound), "the speech");
}

}  // namespace aibo_driver::sound
