// Sound files for the robot, and recordings.
#include "sound/source.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <numeric>

#include "files/files.h"
#include "sound/recording.h"
#include "support/gzip.h"
#include "support/refusal.h"
#include "support/temporary_folder.h"
#include "wav_files.h"

using namespace aibo_driver::sound;
using testing::HasSubstr;

namespace {

using Samples = std::vector<std::int16_t>;

/// The share of a tone of 1 kHz, and its amplitude, by correlation; the ends, where a filter has no data, do not count.
double amplitudeOfTone(const Samples& samples) {
  double sine = 0;
  double cosine = 0;
  const std::size_t begin = 1600;
  const std::size_t end = samples.size() - 1600;
  for (std::size_t i = begin; i < end; ++i) {
    const double phase = 2 * M_PI * 1000 * static_cast<double>(i) / 16000;
    sine += samples[i] * std::sin(phase);
    cosine += samples[i] * std::cos(phase);
  }
  return 2 * std::hypot(sine, cosine) / static_cast<double>(end - begin);
}

class SoundFileTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name).string(); }

  /// Reads it in pieces of odd size.
  Samples readAll(const std::string& name) const {
    const auto source = openSoundFile(path(name));
    Samples all;
    for (Samples part; !(part = source(777)).empty();) {
      all.insert(all.end(), part.begin(), part.end());
      EXPECT_TRUE(part.size() == 777 || source(1).empty()) << "fewer samples before the end";
    }
    return all;
  }

  std::string complaintAbout(const std::string& name) const {
    return test_support::refusalOf<aibo_driver::files::FileException>([&] { openSoundFile(path(name)); });
  }

  test_support::TemporaryFolder folder_;
};

TEST_F(SoundFileTest, AFileWithTheRobotsRateIsPlayedBitByBit) {
  Samples samples = tone(16000);
  samples[5] = 32767;
  samples[6] = -32768;
  writeSoundFile(path("a.wav"), samples);
  EXPECT_EQ(samples, readAll("a.wav"));
  writeSoundFile(path("a.flac"), samples, 16000, 1, SF_FORMAT_FLAC | SF_FORMAT_PCM_16);
  EXPECT_EQ(samples, readAll("a.flac"));
}

TEST_F(SoundFileTest, AGzippedFileIsPlayed) {
  writeSoundFile(path("a.wav"), tone(16000));
  folder_.write("packed.wav", test_support::gzipped(folder_.read("a.wav")));
  EXPECT_EQ(tone(16000), readAll("packed.wav"));
  folder_.write("secret.wav", test_support::gzipped("RIFX is not it"));
  EXPECT_THAT(complaintAbout("secret.wav"), HasSubstr("no WAV, FLAC or Ogg file"));
  folder_.write("bomb.wav", test_support::gzipped(folder_.read("a.wav") + std::string(64U << 20U, '\0')));
  EXPECT_THAT(complaintAbout("bomb.wav"), HasSubstr("has more than the 67108864 bytes allowed"));
}

TEST_F(SoundFileTest, OfSeveralChannelsTheMeanIsPlayed) {
  writeSoundFile(path("a.wav"), {100, 300, -100, 0}, 16000, 2);
  EXPECT_THAT(readAll("a.wav"), testing::ElementsAre(200, -50));
  writeSoundFile(path("most.wav"), {800, 0, 0, 0, 0, 0, 0, 80}, 16000, 8);
  EXPECT_THAT(readAll("most.wav"), testing::ElementsAre(110));
}

TEST_F(SoundFileTest, OtherRatesAreConverted) {
  for (const int rate : {8000, 22050, 44100, 48000}) {
    writeSoundFile(path("a.wav"), tone(static_cast<std::size_t>(rate), rate), rate);
    const Samples samples = readAll("a.wav");
    EXPECT_NEAR(16000, static_cast<double>(samples.size()), 1) << rate << ": all of it, to its end";
    EXPECT_NEAR(10000, amplitudeOfTone(samples), 100) << rate;
    Samples ramp(20000);
    std::iota(ramp.begin(), ramp.end(), std::int16_t{0});
    writeSoundFile(path("ramp.wav"), ramp, rate);
    const Samples converted = readAll("ramp.wav");
    for (std::size_t i = 100; i + 100 < converted.size(); ++i) {
      ASSERT_NEAR(static_cast<double>(i) * rate / 16000, converted[i], 50) << rate << ": nothing twice or left out";
    }
  }
}

TEST_F(SoundFileTest, OggIsPlayed) {
  writeSoundFile(path("a.ogg"), tone(32000), 16000, 1, SF_FORMAT_OGG | SF_FORMAT_VORBIS);
  EXPECT_NEAR(10000, amplitudeOfTone(readAll("a.ogg")), 500);
}

// Anybody may name any file, and an impostor of the robot would get it.
TEST_F(SoundFileTest, OnlySoundsLeaveThisComputer) {
  std::ofstream(path("secret.txt")) << "RIFX is not it";
  EXPECT_THAT(complaintAbout("secret.txt"), HasSubstr("no WAV, FLAC or Ogg file"));
  std::ofstream(path("half.wav")) << "RIFF";
  EXPECT_THAT(complaintAbout("half.wav"), AllOf(HasSubstr("half.wav' cannot be played"), Not(HasSubstr("channels"))));
  EXPECT_THAT(complaintAbout("absent.wav"), HasSubstr("there is no such file"));
  EXPECT_THAT(complaintAbout("a\nb.wav"), HasSubstr("control characters"));
  EXPECT_THAT(complaintAbout("."), HasSubstr("not a regular file"));
  ASSERT_EQ(0, ::mkfifo(path("pipe.wav").c_str(), 0600));
  EXPECT_THAT(complaintAbout("pipe.wav"), HasSubstr("not a regular file"));
}

TEST_F(SoundFileTest, ImpossibleSoundsAreRefused) {
  writeSoundFile(path("many.wav"), Samples(90), 16000, 9);
  EXPECT_THAT(complaintAbout("many.wav"), HasSubstr("9 channels"));
  writeSoundFile(path("slow.wav"), Samples(90), 20);
  EXPECT_THAT(complaintAbout("slow.wav"), HasSubstr("20 samples/s"));
}

TEST_F(SoundFileTest, SamplesThatAreNoNumbersAreSilence) {
  const float samples[] = {NAN, INFINITY, -INFINITY, 1e30F, 0.5F};
  SF_INFO info = {};
  info.samplerate = 16000;
  info.channels = 1;
  info.format = SF_FORMAT_WAV | SF_FORMAT_FLOAT;
  SNDFILE* const file = ::sf_open(path("a.wav").c_str(), SFM_WRITE, &info);
  ::sf_write_float(file, samples, 5);
  ::sf_close(file);
  EXPECT_THAT(readAll("a.wav"), testing::ElementsAre(0, 32767, -32768, 32767, 16384));
}

// Its size costs neither time nor memory.
TEST_F(SoundFileTest, AFileOfFourGigabytesBeginsAtOnce) {
  writeSoundFile(path("a.wav"), Samples(10000, 7));
  {
    std::fstream file(path("a.wav"), std::ios::in | std::ios::out | std::ios::binary);
    const std::string huge = "\xf0\xff\xff\xff";
    file.seekp(4) << huge;
    file.seekp(40) << huge;
  }
  std::filesystem::resize_file(path("a.wav"), std::uintmax_t{0xfffffff8});
  const auto source = openSoundFile(path("a.wav"));
  EXPECT_EQ(Samples(10000, 7), source(10000));
  EXPECT_EQ(Samples(10000, 0), source(10000));
}

TEST_F(SoundFileTest, AFileThatIsCutOffWhileItPlaysEnds) {
  writeSoundFile(path("a.wav"), Samples(100000, 7));
  const auto source = openSoundFile(path("a.wav"));
  EXPECT_THAT(source(1000), testing::SizeIs(1000));
  std::filesystem::resize_file(path("a.wav"), 44);
  EXPECT_GT(50000U, source(100000).size());
  EXPECT_THAT(source(1), testing::IsEmpty());
}

TEST_F(SoundFileTest, MissingSoundIsSilenceInARecording) {
  {
    Recording recording(path("heard.wav"), {true, 2, 16000});
    aibo_client::HeardSound sound;
    sound.channels = 2;
    sound.samples_per_second = 16000;
    sound.samples = {1, 2};
    recording.add(sound);
    sound.missing = 2;
    sound.samples = {3, 5};
    recording.add(sound);
    sound.channels = 1;  // it was on its way when the settings were changed
    recording.add(sound);
    sound.channels = 2;
    sound.samples_per_second = 8000;
    recording.add(sound);
  }
  EXPECT_THAT(readAll("heard.wav"), testing::ElementsAre(2, 0, 0, 4)) << "means, rounded to even";
}

TEST_F(SoundFileTest, ARecordingIsAWholeFileAtEachMoment) {
  Recording recording(path("heard.wav"), {true, 1, 16000});
  aibo_client::HeardSound sound;
  sound.channels = 1;
  sound.samples_per_second = 16000;
  sound.samples = {1, 2};
  recording.add(sound);
  EXPECT_THAT(readAll("heard.wav"), testing::ElementsAre(1, 2));
  sound.samples.resize(16000);
  {
    const test_support::FullDisk full;
    EXPECT_THROW(recording.add(sound), aibo_driver::files::FileException);
  }
  EXPECT_THAT(readAll("heard.wav"), testing::SizeIs((100 - 44) / 2));
}

TEST_F(SoundFileTest, ARecordingReplacesNoFile) {
  std::ofstream(path("mine.wav")) << "mine";
  EXPECT_THROW(Recording(path("mine.wav"), {}), aibo_driver::files::FileException);
}

}  // namespace
