// Speech, by a program in place of espeak-ng.
#include "sound/source.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "files/files.h"
#include "support/refusal.h"
#include "support/temporary_folder.h"
#include "wav_files.h"

using aibo_client::InvalidArgumentException;
using aibo_driver::sound::speak;

namespace {

class SpeechTest : public testing::Test {
 protected:
  SpeechTest() {
    const std::string path = ::getenv("PATH");
    ::setenv("PATH", (folder_.path().string() + ":" + path).c_str(), 1);
    path_ = path;
    writeSoundFile(folder_.path("speech.wav").string(), {1, 2, 3});
  }
  ~SpeechTest() override { ::setenv("PATH", path_.c_str(), 1); }

  /// Has a script take the part of espeak-ng.
  void install(const std::string& script) const {
    const std::string program = folder_.path("espeak-ng").string();
    std::ofstream(program) << "#!/bin/sh\ncd " << folder_.path().string() << "\n" << script << "\n";
    ::chmod(program.c_str(), 0755);
  }

  std::string path_;
  test_support::TemporaryFolder folder_;
};

TEST_F(SpeechTest, TheTextIsSpokenAndNeverAnOption) {
  install("cat > text; echo \"$@\" > arguments; cat speech.wav > \"$5\"");
  EXPECT_THAT(speak("-w /etc/passwd", "de")(10), testing::ElementsAre(1, 2, 3));
  EXPECT_EQ("-w /etc/passwd", folder_.read("text"));
  EXPECT_EQ("-v de --stdin -w /proc/self/fd/3\n", folder_.read("arguments"));
  speak("hello", "");
  EXPECT_EQ("-v en --stdin -w /proc/self/fd/3\n", folder_.read("arguments")) << "unless another voice is named";
}

TEST_F(SpeechTest, AFailureIsReported) {
  for (const std::string end : {"exit 1", "kill -KILL $$"}) {
    install("cat speech.wav > \"$5\"; " + end);
    EXPECT_THAT(test_support::refusalOf<aibo_driver::files::FileException>([&] { speak("hello", "xx"); }),
                testing::HasSubstr("is there a voice 'xx'?"));
  }
}

TEST_F(SpeechTest, WithoutTheProgramTheAnswerSaysWhatToInstall) {
  ::setenv("PATH", "/nowhere", 1);
  EXPECT_THAT(test_support::refusalOf<aibo_driver::files::FileException>([&] { speak("hello", ""); }),
              testing::HasSubstr("sudo apt install espeak-ng"));
}

TEST_F(SpeechTest, ImpossibleTextsAndVoicesAreRefused) {
  install("cat speech.wav > \"$5\"");
  for (const char* const voice : {"en_gb-x+F3", "9"}) {
    EXPECT_NO_THROW(speak(std::string(4000, 'a'), voice)) << voice;
  }
  EXPECT_NO_THROW(speak("hello", std::string(40, 'v')));
  EXPECT_THROW(speak("", ""), InvalidArgumentException);
  EXPECT_THROW(speak(std::string(4001, 'a'), ""), InvalidArgumentException);
  for (const char* const voice : {"/tmp/voice", "-x", "_x", "+x", "a b", "a.b", "voice/"}) {
    EXPECT_THROW(speak("hello", voice), InvalidArgumentException) << voice;
  }
  EXPECT_THROW(speak("hello", std::string(41, 'v')), InvalidArgumentException);
}

}  // namespace
