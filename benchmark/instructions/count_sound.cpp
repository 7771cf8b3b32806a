// Converts, encodes and queues what the robot hears as RCServer does, to count instructions.
//
//   count_sound CHANNELS RATE ROUNDS    16 ms of sound, ROUNDS times: 1 or 2 channels, 8000 or 16000 samples/s
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "rcserver/Outbox.h"
#include "rcserver/body/Microphone.h"

namespace version2 = protocol::version2;

namespace {

constexpr std::size_t kSamples = 256;  // 16 ms

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "count_sound CHANNELS RATE ROUNDS\n");
    return 2;
  }
  // A vector as OVirtualRobotAudioComm has it: its head, then the samples.
  std::vector<long long> memory((sizeof(OSoundVectorData) + kSamples * sizeof(OSoundSampleStereo16)) / 8 + 1);
  auto* const vector = reinterpret_cast<OSoundVectorData*>(memory.data());
  vector->GetInfo(0)->dataOffset = sizeof(OSoundVectorData);
  vector->GetInfo(0)->dataSize = kSamples * sizeof(OSoundSampleStereo16);
  for (std::size_t i = 0; i < kSamples; ++i) {
    const OSoundSampleStereo16 sample = {static_cast<sword>(i * 100), static_cast<sword>(i * -100)};
    std::memcpy(vector->GetData(0) + i * sizeof(sample), &sample, sizeof(sample));
  }
  Microphone microphone;  // it converts even while it is closed
  microphone.Set({0, static_cast<unsigned char>(std::atoi(argv[1])), static_cast<unsigned short>(std::atoi(argv[2]))});
  std::vector<unsigned char> message(Outbox::MAX_SOUND_SIZE);
  std::vector<unsigned char> out(Outbox::MAX_SOUND_SIZE);
  auto queue = std::make_unique<MessageQueue<Outbox::SOUND_CAPACITY>>();
  unsigned char* const payload = message.data() + version2::FRAME_HEADER_SIZE;
  std::size_t bytes = 0;
  for (int round = std::atoi(argv[3]); round > 0; --round) {
    version2::HeardSound heard = microphone.Convert(vector, payload + version2::HEARD_SOUND_HEADER_SIZE);
    bytes = version2::FRAME_HEADER_SIZE + version2::HEARD_SOUND_HEADER_SIZE + heard.samples_size;
    heard.samples_size = 0;
    encode(heard, payload);
    const version2::FrameHeader header = {version2::SOUND_PUSH, version2::SOUND_MICROPHONE, 0,
                                          static_cast<unsigned>(bytes - version2::FRAME_HEADER_SIZE)};
    encode(header, message.data());
    queue->Add(message.data(), bytes);
    queue->Take(bytes, out.data());
  }
  std::printf("%zu bytes\n", bytes);
  return 0;
}
