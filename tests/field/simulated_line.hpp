// A bus and its devices as child processes.
#pragma once

#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <sys/types.h>
#include <vector>

namespace plcgw::field {

class simulated_line {
public:
    simulated_line(std::string link, std::filesystem::path pid_dir)
        : link_(std::move(link)), pid_dir_(std::move(pid_dir))
    {
    }
    ~simulated_line();  // ends every process and removes every file
    simulated_line(const simulated_line&) = delete;
    simulated_line& operator=(const simulated_line&) = delete;

    void start(const std::vector<std::string>& devices);
    void signal_bus(int signal) const { ::kill(bus_, signal); }
    void report_ended();  // throws if it was the bus: without it nothing is left to do

private:
    void start_device(const std::string& device, std::size_t number);
    void add(pid_t pid, const std::string& name);
    void forget(pid_t pid);
    std::filesystem::path pid_file(const std::string& name) const { return pid_dir_ / (name + ".pid"); }

    std::string link_;
    std::filesystem::path pid_dir_;  // empty: no pid files
    bool made_pid_dir_ = false;
    pid_t bus_ = 0;
    std::map<pid_t, std::string> names_;  // "bus" or the unit id
    std::size_t ports_ = 0;
};

}  // namespace plcgw::field
