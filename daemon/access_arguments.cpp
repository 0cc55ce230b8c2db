#include "daemon/access_arguments.hpp"

#include "daemon/config/read.hpp"
#include "daemon/run.hpp"

namespace plcgw {
namespace {

// By DDS: what has not begun when nobody waits any more must not happen later.
constexpr unsigned default_timeout_ms = 5000;
constexpr unsigned time_to_finish_ms = 3000;  // for a device that is silent

}  // namespace

void access_arguments::add_to(CLI::App& app)
{
    read_ =
        app.add_subcommand("read", "Read a point, devices of a PLC or registers of a station of the running gateway");
    read_
        ->add_option("target", options_.target, "Point, plc:D100, station/holding:100, station/DT100 or line#7/input:0")
        ->required();
    read_->add_option("-n,--count", options_.count, "So many values; of text so many characters")
        ->check(CLI::Range(1, 2000))
        ->capture_default_str();
    add_form(*read_);
    add_shared(*read_);

    write_ = app.add_subcommand("write", "Write a point, devices of a PLC or registers of a station, and say what the "
                                         "device answered");
    write_
        ->add_option("target", options_.target,
                     "As of read; with --dds a point, or registers of a route: route/holding:100")
        ->required();
    write_->add_option("values", options_.values, "Values, one after the other; behind -- if the first is negative")
        ->required();
    add_form(*write_);
    add_shared(*write_);
    add_dds(*write_);

    send_ = app.add_subcommand("send", "Send a message on a general-purpose line of the running gateway");
    send_->add_option("line", options_.target, "Name of the line")->required();
    send_->add_option("text", text_, "Without start and end codes; <CR>, \\r and \\x02 are control characters")
        ->required();
    add_shared(*send_);
    add_dds(*send_);
}

void access_arguments::add_form(CLI::App& command)
{
    command.add_option("--type", options_.type,
                       "What the registers hold, as a point's type: int32, float, bcd16, text ...");
    command.add_option("--order", options_.order, "How they follow each other, as a point's order: ABCD, CDAB, ...");
}

void access_arguments::add_shared(CLI::App& command)
{
    command.add_option("-t,--timeout", timeout_ms_,
                       "Refuse it if it cannot begin within so many milliseconds; default 10000, by DDS 5000. By DDS "
                       "the reply is waited for 3 s longer");
    command.add_flag("--json", options_.json, "Print the reply as a JSON object");
    command.add_option("--socket", options_.socket, "Control socket of the gateway; default: where it usually is");
}

void access_arguments::add_dds(CLI::App& command)
{
    command.add_flag("--dds", by_dds_, "By DDS instead, from any host");
    command.add_option("-c,--config", config_file_,
                       "Take the DDS settings and the gateway's name from this configuration");
    command.add_option("-d,--domain", dds_.dds.domain, "DDS domain")->check(CLI::Range(0, 230))->capture_default_str();
    command.add_option("-i,--interface", dds_.dds.interface, "Network interface; empty: the first suitable")
        ->capture_default_str();
    command.add_option("--peer", dds_.dds.peers, "Address of a host that multicast does not reach");
    command.add_option("--partition", dds_.dds.partition, "DDS partition");
    command.add_option("-g,--gateway", dds_.gateway, "Name of the gateway")->capture_default_str();
    CLI::Option* const client = command.add_option("--client", dds_.client, "Who asks; default: a name of its own");
    command.add_option("--request", dds_.request, "Number among the client's requests: each is executed once")
        ->needs(client);
}

std::optional<int> access_arguments::run()
{
    options_.timeout_ms = timeout_ms_;
    if (*read_)
        return read_over_socket(options_);
    if (!*write_ && !*send_)
        return std::nullopt;
    if (*send_)
        options_.values = {text_};
    if (!by_dds_)
        return *send_ ? send_over_socket(options_) : write_over_socket(options_);
    if (!config_file_.empty()) {
        const auto loaded = config::load_file(config_file_);
        if (config::has_errors(loaded.found))
            return check(config_file_);  // says what is wrong with it
        dds_.dds = loaded.config.dds.settings;
        dds_.gateway = loaded.config.gateway;
    }
    if (timeout_ms_ == 0)
        options_.timeout_ms = default_timeout_ms;
    dds_.wait_ms = options_.timeout_ms + time_to_finish_ms;
    return *send_ ? send_by_dds(options_, dds_) : write_by_dds(options_, dds_);
}

}  // namespace plcgw
