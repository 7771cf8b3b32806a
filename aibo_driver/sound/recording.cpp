#include "sound/recording.h"

#include <fcntl.h>
#include <sndfile.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "files/files.h"
#include "host_files/file_descriptor.h"

namespace aibo_driver::sound {

using files::FileException;

namespace {

constexpr std::size_t kBlock = 16000;  // samples of each channel

}  // namespace

Recording::Recording(const std::string& path, const aibo_client::MicrophoneSettings& settings)
    : path_(path), settings_(settings), file_(nullptr, ::sf_close) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    throw FileException("cannot write '" + path + "': " + std::strerror(errno) +
                        (errno == EEXIST ? "; give another name, or remove it" : ""));
  }
  SF_INFO info = {};
  info.samplerate = settings.samples_per_second;
  info.channels = settings.channels;
  info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
  file_.reset(::sf_open_fd(descriptor, SFM_WRITE, &info, SF_TRUE));
  if (!file_) {
    ::unlink(path.c_str());
    throw FileException("cannot write '" + path + "': " + ::sf_strerror(nullptr));
  }
  ::sf_command(file_.get(), SFC_SET_UPDATE_HEADER_AUTO, nullptr, SF_TRUE);
}

void Recording::add(const aibo_client::HeardSound& sound) {
  if (sound.channels != settings_.channels || sound.samples_per_second != settings_.samples_per_second) {
    return;
  }
  const auto channels = static_cast<std::size_t>(settings_.channels);
  const std::vector<std::int16_t> silence(kBlock * channels);
  for (std::size_t missing = sound.missing; missing > 0; missing -= std::min(missing, kBlock)) {
    write(silence.data(), std::min(missing, kBlock));
  }
  write(sound.samples.data(), sound.samples.size() / channels);
}

void Recording::write(const std::int16_t* samples, std::size_t frames) {
  if (::sf_writef_short(file_.get(), samples, static_cast<sf_count_t>(frames)) != static_cast<sf_count_t>(frames)) {
    throw FileException("cannot write '" + path_ + "': " + ::sf_strerror(file_.get()));
  }
}

}  // namespace aibo_driver::sound
