// The command line of fast-dds-peer.
#include "tests/fastdds/request.hpp"
#include "tests/fastdds/subscribe.hpp"

#include <CLI/CLI.hpp>

#include <csignal>
#include <iostream>

namespace {

volatile std::sig_atomic_t stopped = 0;

}  // namespace

int main(int argc, char** argv)
{
    fast_dds::settings where;
    CLI::App app("A foreign DDS participant, on Fast DDS and loopback, for the topics of plc-gateway");
    app.require_subcommand(1);
    app.add_option("--domain", where.domain);
    app.add_option("--partition", where.partition, "default: the default one");

    std::vector<std::string> topics = fast_dds::subscribed_topics();
    auto* subscribe = app.add_subcommand("subscribe", "print samples as lines of JSON until SIGTERM");
    subscribe->add_option("topics", topics, "default: all")->check(CLI::IsMember(fast_dds::subscribed_topics()));

    std::string topic;
    std::string content;
    fast_dds::patience waits;
    unsigned repeat_ms = 100;
    unsigned longest_ms = 20'000;
    auto* request = app.add_subcommand("request", "write a request until its reply comes; exit status 1: none came");
    request->add_option("topic", topic)->required()->check(CLI::IsMember(fast_dds::request_topics()));
    request->add_option("content", content, "JSON with the fields of the IDL")->required();
    request->add_option("--repeat-ms", repeat_ms, "how often it is written again");
    request->add_option("--longest-ms", longest_ms, "how long the reply is waited for");
    CLI11_PARSE(app, argc, argv);

    try {
        if (subscribe->parsed()) {
            std::signal(SIGTERM, [](int) { stopped = 1; });
            fast_dds::subscribe(where, topics, stopped);
            return 0;
        }
        waits.repeat = std::chrono::milliseconds(repeat_ms);
        waits.longest = std::chrono::milliseconds(longest_ms);
        return fast_dds::request(where, topic, content, waits) ? 0 : 1;
    }
    catch (const std::exception& error) {
        std::cerr << "fast-dds-peer: " << error.what() << '\n';
        return 2;
    }
}
