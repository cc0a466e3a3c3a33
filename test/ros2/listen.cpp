#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "ros2/fast_peer.h"

// ros2_listen DOMAIN SECONDS
//
// Subscribes to every topic offered on this host within the first two seconds, listens, and prints
// the messages received from each. A tool for experiments by hand.

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: ros2_listen DOMAIN SECONDS\n");
    return 2;
  }
  const int seconds = std::atoi(argv[2]);
  tera::FastPeer peer(std::atoi(argv[1]));
  sleep(2);
  const std::map<std::string, tera::OfferedTopic> offers = peer.Offers();
  for (const auto& [topic, offer] : offers) {
    peer.Subscribe({topic, offer.type, offer.reliable, offer.transient_local});
  }
  std::map<std::string, std::pair<long, double>> come;  // messages, megabytes
  for (int tenth = 0; tenth < 10 * seconds; ++tenth) {
    usleep(100'000);
    for (const auto& [topic, offer] : offers) {
      while (peer.Waiting(topic) > 0) {
        come[topic].first += 1;
        come[topic].second += 1e-6 * static_cast<double>(peer.Next(topic)->size());
      }
    }
  }
  for (const auto& [topic, offer] : offers) {
    std::printf("%-36s %-40s %7.1f Hz %8.3f MB/s\n", topic.c_str(), offer.type.c_str(),
                static_cast<double>(come[topic].first) / seconds, come[topic].second / seconds);
  }
  return 0;
}
