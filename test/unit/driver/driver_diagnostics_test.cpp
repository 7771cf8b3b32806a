#include "node/driver_diagnostics.h"

#include <gmock/gmock.h>

namespace aibo_driver::node {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

TEST(DiagnosticCounts, AreEachUnderTheirName) {
  aibo_client::ClientStatistics client;
  client.connections = 1;
  client.failed_attempts = 2;
  client.stalls = 3;
  client.protocol_errors = 4;
  client.bytes_received = 5;
  EXPECT_THAT(connectionCounts(client), ElementsAre(Pair("connections made", 1), Pair("attempts failed", 2),
                                                    Pair("streams given up for silence", 3), Pair("protocol errors", 4),
                                                    Pair("bytes received", 5)));
  client.pictures = 11;
  client.corrupt_pictures = 12;
  client.unexpected_pictures = 13;
  client.stale_pictures = 14;
  RawImagePublisher::Statistics images;
  images.published = 15;
  images.decode_errors = 16;
  images.skipped = 17;
  EXPECT_THAT(
      pictureCounts(client, images),
      ElementsAre(Pair("pictures received", 11), Pair("pictures damaged", 12), Pair("pictures nobody asked for", 13),
                  Pair("pictures dropped for newer ones", 14), Pair("images decoded", 15),
                  Pair("images not decodable", 16), Pair("images dropped for newer ones", 17)));
  client.telemetry = 21;
  client.dropped_telemetry = 22;
  client.thinned_telemetry = 23;
  client.impossible_values = 24;
  client.refusals = 25;
  EXPECT_THAT(jointCounts(client),
              ElementsAre(Pair("measurements received", 21), Pair("measurements dropped for newer ones", 22),
                          Pair("measurements dropped, more than asked for", 23), Pair("impossible values dropped", 24),
                          Pair("requests refused by the robot", 25)));
  client.sounds = 31;
  client.sound_gaps = 32;
  client.thinned_sounds = 33;
  EXPECT_THAT(soundCounts(client),
              ElementsAre(Pair("messages", 31), Pair("gaps", 32), Pair("messages dropped, more than asked for", 33)));
}

TEST(DiagnosticCounts, OfDatagramsAreThereOnceAnyHasCome) {
  aibo_client::ClientStatistics client;
  EXPECT_THAT(datagramCounts(client), testing::IsEmpty());
  client.foreign_datagrams = 6;
  EXPECT_THAT(datagramCounts(client), testing::SizeIs(8));
  client.datagrams = 1;
  client.lost_datagrams = 2;
  client.reordered_datagrams = 3;
  client.duplicate_datagrams = 4;
  client.bad_datagrams = 5;
  client.repaired_datagrams = 7;
  client.lost_pictures = 8;
  EXPECT_THAT(datagramCounts(client),
              ElementsAre(Pair("datagrams received", 1), Pair("datagrams lost", 2), Pair("datagrams out of order", 3),
                          Pair("datagrams that came twice", 4), Pair("datagrams that are no part of a picture", 5),
                          Pair("datagrams from strangers", 6), Pair("lost datagrams that were repaired", 7),
                          Pair("pictures lost with a datagram", 8)));
}

}  // namespace
}  // namespace aibo_driver::node
