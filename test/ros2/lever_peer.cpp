#include <cstdio>
#include <cstdlib>
#include <string>

#include "ros2/cdr.h"
#include "ros2/fast_peer.h"

// lever_peer DOMAIN MACHINE BOOM
//
// Answers every /clock with the boom's lever, and prints its stamp. The lever alternates between
// BOOM and -BOOM every two seconds of simulated time. The boom thus always moves, and never rests
// at the end of its stroke. It is a separate program so that a test can kill it.

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: lever_peer DOMAIN MACHINE BOOM\n");
    return 2;
  }
  tera::FastPeer peer(std::atoi(argv[1]));
  const std::string levers = "rt/" + std::string(argv[2]) + "/delta_can";
  peer.Advertise({.topic = levers, .type = "tera_msgs::msg::dds_::DeltaCAN_", .reliable = true});
  peer.Subscribe({.topic = "rt/clock", .type = "rosgraph_msgs::msg::dds_::Clock_"});
  while (const auto clock = peer.Next("rt/clock")) {
    tera::CdrReader cdr(*clock);
    tera::LeverMessage message{.stamp_sec = cdr.I32(), .stamp_nanosec = cdr.U32()};
    const float boom = std::strtof(argv[3], nullptr);
    message.boom = message.stamp_sec % 4 < 2 ? boom : -boom;
    peer.Publish(levers, message.Encode());
    std::printf("%d.%09u\n", message.stamp_sec, message.stamp_nanosec);
    std::fflush(stdout);
  }
  return 0;
}
