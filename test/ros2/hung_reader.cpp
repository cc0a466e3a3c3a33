#include <signal.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "ros2/fast_peer.h"

// hung_reader DOMAIN TOPIC TYPE [TOPIC TYPE]...
//
// Reads the topics reliably until a message of each arrives, then stops itself: present, but
// neither reading nor acknowledging.

int main(int argc, char** argv) {
  if (argc < 4 || argc % 2 != 0) {
    std::fprintf(stderr, "usage: hung_reader DOMAIN TOPIC TYPE [TOPIC TYPE]...\n");
    return 2;
  }
  tera::FastPeer peer(std::atoi(argv[1]));
  std::vector<std::string> topics;
  for (int i = 2; i < argc; i += 2) {
    topics.push_back(argv[i]);
    peer.Subscribe({.topic = argv[i], .type = argv[i + 1], .reliable = true});
  }
  for (const std::string& topic : topics) {
    if (!peer.Next(topic)) return 1;
  }
  raise(SIGSTOP);
  return 0;
}
