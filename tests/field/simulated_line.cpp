#include "tests/field/simulated_line.hpp"

#include "tests/field/process.hpp"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

namespace plcgw::field {

namespace fs = std::filesystem;

simulated_line::~simulated_line()
{
    std::error_code ignored;
    while (!names_.empty()) {
        // The bus last: a device whose line goes away complains.
        const auto device = std::ranges::find_if(names_, [&](const auto& entry) { return entry.first != bus_; });
        const pid_t pid = device != names_.end() ? device->first : bus_;
        end_process(pid);
        forget(pid);
    }
    if (made_pid_dir_)
        fs::remove(pid_dir_, ignored);  // unless it holds files of somebody else

    // A bus that was killed has left its links.
    for (std::size_t i = 0; i <= ports_; ++i) {
        const fs::path link = i == 0 ? link_ : link_ + "." + std::to_string(i);
        if (fs::is_symlink(link, ignored) && !fs::exists(link, ignored))
            fs::remove(link, ignored);
    }
}

void simulated_line::start(const std::vector<std::string>& devices)
{
    if (!pid_dir_.empty())
        made_pid_dir_ = fs::create_directories(pid_dir_);
    ports_ = devices.size();
    bus_ = start_sibling("field-bus", {"--link", link_, "--ports", std::to_string(ports_)}, SIGTERM);
    add(bus_, "bus");
    for (std::size_t i = 0; i < devices.size(); ++i)
        start_device(devices[i], i + 1);
}

// UNIT[:PROFILE[:TCPPORT]], where PROFILE may be empty
void simulated_line::start_device(const std::string& device, std::size_t number)
{
    std::vector<std::string> arguments{"--port", link_ + "." + std::to_string(number)};
    std::istringstream parts(device);
    std::string part;
    for (const char* option : {"--unit", "--profile", "--tcp"}) {
        if (std::getline(parts, part, ':') && !part.empty())
            arguments.insert(arguments.end(), {option, part});
    }
    // A device has nothing to tidy up; SIGKILL also ends one that a test has stopped.
    add(start_sibling("field-device", arguments, SIGKILL), device.substr(0, device.find(':')));
}

void simulated_line::report_ended()
{
    while (const auto ended = reap()) {
        const std::string what = (ended->pid == bus_ ? "the bus " : "device " + names_[ended->pid] + " ") + ended->how;
        forget(ended->pid);
        if (ended->pid == bus_)
            throw std::runtime_error(what);
        std::cerr << "field-line: " << what << ", the others go on" << std::endl;
    }
}

void simulated_line::add(pid_t pid, const std::string& name)
{
    names_[pid] = name;
    if (!pid_dir_.empty())
        std::ofstream(pid_file(name)) << pid << '\n';
}

void simulated_line::forget(pid_t pid)
{
    std::error_code ignored;
    if (!pid_dir_.empty())
        fs::remove(pid_file(names_[pid]), ignored);
    names_.erase(pid);
}

}  // namespace plcgw::field
