// Child processes that never outlive us.
#pragma once

#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace plcgw::field {

struct ended_process {
    pid_t pid;
    std::string how;  // "exited with 1", "was ended by signal 9"
};

// Starts one of the programs that were built next to this one and returns when it has printed its first line.
// signal_when_orphaned reaches it even if this process is killed with -9.
pid_t start_sibling(const std::string& program, std::vector<std::string> arguments, int signal_when_orphaned);

std::optional<ended_process> reap();  // one that has ended, if any has

// SIGTERM, then SIGKILL for what is still there after two seconds.
void end_process(pid_t pid);

}  // namespace plcgw::field
