#include "tests/bench/bench_dds_writer.hpp"

#include "bridge/dds/bounded_string.hpp"
#include "registers.h"

#include <nlohmann/json.hpp>

#include <array>

namespace plcgw::bench {
namespace {

constexpr std::uint32_t block_words = 10;

dds_return_t write_point(dds_entity_t to, unsigned instance, std::uint64_t number)
{
    plcgw_v1_Point out{};
    fill_string(out.gateway, "bench");
    fill_string(out.name, "point" + std::to_string(instance));
    fill_string(out.member, "bare");
    out.seq = number;
    out.source_ns = monotonic_ns();
    out.quality = plcgw_v1_QUALITY_GOOD;
    out.kind = plcgw_v1_KIND_INTEGER;
    out.integer = static_cast<std::int64_t>(number);
    out.real = static_cast<double>(number);
    return dds_write(to, &out);
}

dds_return_t write_block(dds_entity_t to, unsigned instance, std::uint64_t number)
{
    std::array<std::uint16_t, block_words> words{};
    words.fill(static_cast<std::uint16_t>(number));
    plcgw_v1_RegisterBlock out{};
    fill_string(out.gateway, "bench");
    fill_string(out.route, "block" + std::to_string(instance));
    fill_string(out.area, "holding");
    fill_string(out.member, "bare");
    out.seq = number;
    out.quality = plcgw_v1_QUALITY_GOOD;
    out.count = out.words._length = out.words._maximum = block_words;
    out.words._buffer = words.data();
    out.source_ns = monotonic_ns();
    return dds_write(to, &out);
}

}  // namespace

writer::writer(const dds_settings& settings, const load& wanted)
    : parts_(settings), wanted_(wanted),
      to_(wanted.blocks ? parts_.make_writer(plcgw_v1_RegisterBlock_desc, topic_name(dds_topic::register_block))
                        : parts_.make_writer(plcgw_v1_Point_desc, topic_name(dds_topic::point))),
      thread_([this] { run(); })
{
}

writer::~writer()
{
    ended_ = true;
    thread_.join();
}

void writer::write(unsigned instance, std::uint64_t number)
{
    const dds_return_t written = (wanted_.blocks ? write_block : write_point)(to_, instance, number);
    ++(written == DDS_RETCODE_OK ? written_ : failed_);
}

void writer::run()
{
    std::uint64_t number = 0;
    for (unsigned i = 0; i < wanted_.instances; ++i)
        write(i, ++number);
    unsigned instance = 0;
    auto next = std::chrono::steady_clock::now();
    while (!ended_) {
        for (unsigned i = 0; i < wanted_.burst; ++i) {
            write(instance, ++number);
            instance = (instance + 1) % wanted_.instances;
        }
        if (wanted_.period.count() != 0)
            std::this_thread::sleep_until(next += wanted_.period);
    }
}

nlohmann::json writer::report() { return {{"written", written_.exchange(0)}, {"failed", failed_.exchange(0)}}; }

}  // namespace plcgw::bench
