#include "view/view_server.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/faults.h"
#include "view/small_recording.h"

// Responses over a plain socket, byte by byte, so that no client normalises a path first.

namespace tera {
namespace {

using enum FaultKind;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A connection to a port of an address of this computer; -1 without a listener.
int Connect(const char* address, int port) {
  const int connection = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, address, &place.sin_addr);
  if (connect(connection, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0) {
    return connection;
  }
  close(connection);
  return -1;
}

/// Header and body of the response to this request.
std::string Ask(int port, const std::string& request) {
  const int connection = Connect("127.0.0.1", port);
  EXPECT_GE(connection, 0);
  EXPECT_EQ(write(connection, request.data(), request.size()),
            static_cast<ssize_t>(request.size()));
  std::string answer;
  char piece[4096];
  for (ssize_t n; (n = read(connection, piece, sizeof piece)) > 0;) answer.append(piece, n);
  close(connection);
  return answer;
}

class ServerOfASmallRecording : public testing::Test {
 protected:
  std::string Request(const std::string& method, const std::string& path,
                      const std::string& more = "") {
    return Ask(server_.port(),
               fmt::format("{} {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n{}\r\n",
                           method, path, server_.port(), more));
  }
  static std::vector<Viewed> Things() {
    WriteFileAt(OwnFolder() / "secret.txt", "secret");
    Viewed viewed = OpenViewed(SmallRecording("served_recording"));
    viewed.stage = [] { return std::string("the scene"); };
    Viewed real = viewed;
    real.stage = []() -> std::string { throw InputError("no scenario says what it looks like"); };
    return {viewed, real};
  }

  ViewServer server_{Things(), "the page", 0};
};

TEST_F(ServerOfASmallRecording, SendsPageIndexSceneAndFiles) {
  EXPECT_THAT(Request("GET", "/"), testing::AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("the page"),
                                                  HasSubstr("Content-Security-Policy")));
  EXPECT_THAT(Request("GET", "/index.json"), HasSubstr("\"digger/commands.csv\""));
  EXPECT_THAT(Request("GET", "/stage/0"), HasSubstr("the scene"));
  EXPECT_THAT(Request("GET", "/data/0/digger/camera/rgb/0.png"), HasSubstr("first picture"));
  EXPECT_THAT(Request("HEAD", "/data/0/digger/camera/rgb/0.png"),
              testing::AllOf(StartsWith("HTTP/1.1 200"), Not(HasSubstr("first picture"))));
}

// Compression for a reader on the same computer would only take time: Brotli needs a second for the
// page.
TEST_F(ServerOfASmallRecording, PacksNothing) {
  for (const char* const path : {"/", "/index.json", "/stage/0"}) {
    const std::string answer = Request("GET", path, "Accept-Encoding: gzip, deflate, br\r\n");
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 200")) << path;
    EXPECT_THAT(answer, Not(HasSubstr("Content-Encoding"))) << path;
  }
}

TEST_F(ServerOfASmallRecording, SendsRangesOfFiles) {
  const std::string path = "/data/0/digger/commands.csv";  // "t_ns,boom\n0,0.5\n..."
  const std::string middle = Request("GET", path, "Range: bytes=5-8\r\n");
  EXPECT_THAT(middle, testing::AllOf(StartsWith("HTTP/1.1 206"), testing::EndsWith("\r\n\r\nboom"),
                                     HasSubstr("Content-Range: bytes 5-8/30")));
  EXPECT_THAT(Request("GET", path, "Range: bytes=26-\r\n"), testing::EndsWith("\r\n\r\n,-1\n"));
  EXPECT_THAT(Request("GET", path, "Range: bytes=26-99\r\n"), testing::EndsWith("\r\n\r\n,-1\n"));
  EXPECT_THAT(Request("GET", path, "Range: bytes=-3\r\n"), testing::EndsWith("\r\n\r\n-1\n"));
  for (const char* range : {"100-", "30-40", "0-1,0-1"}) {
    EXPECT_THAT(Request("GET", path, fmt::format("Range: bytes={}\r\n", range)),
                testing::AllOf(StartsWith("HTTP/1.1 416"), HasSubstr("Content-Range: bytes */30")))
        << range;
  }
}

TEST_F(ServerOfASmallRecording, SendsNothingFromElsewhere) {
  for (const std::string path :
       {"/data/0/../secret.txt", "/data/0/%2e%2e/secret.txt", "/data/0/..%2fsecret.txt",
        "/data/0/digger/../../secret.txt", "/data/0/%2e%2e%2fsecret.txt", "/data/0//etc/passwd",
        "/data/0/%2fetc%2fpasswd", "/../secret.txt", "/data/2/dataset.yaml", "/data/0/digger",
        "/data/9999/dataset.yaml", "/secret.txt", "/stage/2", "/data/0/"}) {
    EXPECT_THAT(Request("GET", path),
                testing::AllOf(StartsWith("HTTP/1.1 4"), Not(HasSubstr("secret\n")),
                               Not(testing::EndsWith("secret"))))
        << path;
  }
}

TEST_F(ServerOfASmallRecording, IsOnlyReadFrom) {
  for (const char* method : {"POST", "PUT", "DELETE", "PATCH", "OPTIONS"}) {
    EXPECT_THAT(Request(method, "/data/0/digger/commands.csv", "Content-Length: 0\r\n"),
                StartsWith("HTTP/1.1 405"))
        << method;
  }
}

TEST_F(ServerOfASmallRecording, AnswersThisComputerAlone) {
  EXPECT_THAT(Ask(server_.port(),
                  "GET /index.json HTTP/1.1\r\nHost: elsewhere.example\r\n"
                  "Connection: close\r\n\r\n"),
              StartsWith("HTTP/1.1 403"));
  EXPECT_EQ(Connect("127.0.0.2", server_.port()), -1);  // loopback too, but not the bound address
  EXPECT_EQ(server_.address(), fmt::format("http://127.0.0.1:{}/", server_.port()));
}

TEST_F(ServerOfASmallRecording, SaysWhyASceneIsNotKnown) {
  EXPECT_THAT(
      Request("GET", "/stage/1"),
      testing::AllOf(StartsWith("HTTP/1.1 404"), HasSubstr("no scenario says what it looks like")));
}

TEST_F(ServerOfASmallRecording, RefusesAPortThatIsTaken) {
  EXPECT_THAT([&] { const ViewServer second({}, "", server_.port()); }, ThrowsFault(kUnwritable));
}

}  // namespace
}  // namespace tera
