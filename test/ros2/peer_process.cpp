#include "ros2/peer_process.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

namespace tera {

PeerProcess::PeerProcess(std::vector<std::string> command) {
  std::vector<char*> arguments;
  for (std::string& argument : command) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    freopen("/dev/null", "w", stdout);
    execv(arguments[0], arguments.data());
    _exit(126);
  }
}

void PeerProcess::Kill() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  pid_ = -1;
}

void PeerProcess::Signal(int number) const { kill(pid_, number); }

bool PeerProcess::IsStopped() {
  int status = 0;
  if (waitpid(pid_, &status, WUNTRACED | WNOHANG) == pid_) stopped_ = WIFSTOPPED(status);
  return stopped_;
}

std::vector<std::string> LeverPeer(const std::string& machine, const std::string& boom) {
  return {LEVER_PEER, std::to_string(OwnDomainId()), machine, boom};
}

std::vector<std::string> HungReader(const std::vector<FastPeer::Wish>& wishes) {
  std::vector<std::string> command = {HUNG_READER, std::to_string(OwnDomainId())};
  for (const FastPeer::Wish& wish : wishes) {
    command.push_back(wish.topic);
    command.push_back(wish.type);
  }
  return command;
}

}  // namespace tera
