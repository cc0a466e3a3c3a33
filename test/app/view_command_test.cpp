#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "app/refused.h"
#include "core/faults.h"

// `tera view` from a user's view, on a hand-written recording. The drawing is tested in a browser
// (test/view/view_in_browser_test.py).

namespace tera {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

void WriteRecording(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "digger");
  WriteWholeFile(folder / "dataset.yaml",
                 "format: 1\ntera_version: \"0.2.0\"\nname: hand\nsimulated: false\nseed: 0\n"
                 "duration_s: 2\norigin: {lat_deg: 47, lon_deg: 8, height_m: 460}\nchannels:\n"
                 "  - {path: digger/commands.csv, type: table}\n"
                 "classes:\n  - {id: 0, name: sky}\ninstances: []\n");
  WriteWholeFile(folder / "digger" / "commands.csv", "t_ns,boom\n0,0.5\n1000000000,-1\n");
}

bool PageIsBuilt() { return std::filesystem::exists(TERA_BUILT_PAGE); }

/// A port of this computer without a listener.
int FreePort() {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof place;
  bind(listener, reinterpret_cast<sockaddr*>(&place), size);
  getsockname(listener, reinterpret_cast<sockaddr*>(&place), &size);
  close(listener);
  return ntohs(place.sin_port);
}

bool Answers(int port) {
  const int connection = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(static_cast<std::uint16_t>(port));
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool is_there = connect(connection, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0;
  close(connection);
  return is_there;
}

TEST(ViewCommand, RefusesWhatIsNoDatasetAndNoDiagnosis) {
  const ScratchDirectory scratch;
  std::filesystem::create_directories(scratch.path() / "empty");
  ExpectRefused(scratch, {"view", "empty"}, TellsOf("empty"));
  ExpectRefused(scratch, {"view", "none"}, TellsOf("none"));
  WriteRecording(scratch.path() / "a");
  ExpectRefused(scratch, {"view", "a", "a", "a"}, TellsOf("PATH"));
}

TEST(ViewCommand, RefusesOptionsThatCannotBe) {
  const ScratchDirectory scratch;
  WriteRecording(scratch.path() / "a");
  for (const Arguments& arguments :
       {Arguments{"view", "a", "--port", "99999"}, Arguments{"view", "a", "--size", "5"},
        Arguments{"view", "a", "--export", "a.html", "--port", "8080"}, Arguments{"view"}}) {
    const Outcome outcome = RunTera(arguments, {scratch.path()});
    EXPECT_EQ(outcome.status, 2) << outcome.out << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "a.html"));
  }
}

TEST(ViewCommand, WritesOneFile) {
  if (!PageIsBuilt()) GTEST_SKIP() << "the page was not built";
  const ScratchDirectory scratch;
  WriteRecording(scratch.path() / "a");
  const Outcome outcome = RunTera({"view", "a", "--export", "a.html"}, {scratch.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::AllOf(StartsWith("a.html: "), HasSubstr("An excerpt")));
  EXPECT_THAT(ReadWholeFile(scratch.path() / "a.html"), HasSubstr("0/digger/commands.csv"));
}

TEST(ViewCommand, ServesUntilItIsInterrupted) {
  if (!PageIsBuilt()) GTEST_SKIP() << "the page was not built";
  const ScratchDirectory scratch;
  WriteRecording(scratch.path() / "a");
  const int port = FreePort();
  TeraProcess viewing({"view", "a", "--port", std::to_string(port)}, {scratch.path()});
  while (viewing.Running() && !Answers(port)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ExpectRefused(scratch, {"view", "a", "--port", std::to_string(port)},
                HasSubstr("cannot be bound on 127.0.0.1"));
  viewing.Signal(SIGINT);
  const Outcome outcome = viewing.Wait();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "look at http://127.0.0.1:" + std::to_string(port) + "/ (Ctrl-C ends)\n");
}

}  // namespace
}  // namespace tera
