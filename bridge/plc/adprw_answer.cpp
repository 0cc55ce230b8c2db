#include "bridge/plc/adprw_command.hpp"
#include "protocols/modbus/wire.hpp"

#include <algorithm>

namespace plcgw::plc {
namespace {

using values = std::vector<std::uint16_t>;

// One overload for each answer; false when it does not fit the question.
struct storer {
    const adprw_command& asked;
    memory& devices;

    bool operator()(const modbus::bits_read& a) const
    {
        const auto* question = std::get_if<modbus::read_table>(&asked.request);
        if (question == nullptr || !is_bit_table(question->from) || a.values.size() != question->count || !asked.target)
            return false;
        for (std::size_t i = 0; i < a.values.size(); ++i)
            devices.set_bit({asked.target->area, asked.target->bit + i}, a.values[i]);
        return true;
    }
    bool operator()(const modbus::registers_read& a) const
    {
        return a.values.size() == registers_asked() && store(a.values);
    }
    bool operator()(const modbus::exception_status_read& a) const
    {
        return is<modbus::read_exception_status>() && store({a.status});
    }
    bool operator()(const modbus::diagnostics_answered& a) const
    {
        const auto* question = std::get_if<modbus::diagnostics>(&asked.request);
        if (question == nullptr || a.data.size() != 2)
            return false;
        const bool delimiter = question->what == modbus::diagnostic::change_ascii_delimiter;
        return store({delimiter ? std::uint16_t{a.data[0]} : modbus::read_word(a.data, 0)});
    }
    bool operator()(const modbus::event_counter_read& a) const
    {
        return is<modbus::get_comm_event_counter>() && store({a.status, a.events});
    }
    // Two events in a word, the newer one in its low byte (9.5.1). Words behind the last event keep what they held.
    bool operator()(const modbus::event_log_read& a) const
    {
        const std::size_t length = std::min<std::size_t>(a.log.size(), 2 * event_log_words);
        values all{a.status, a.events, a.messages, static_cast<std::uint16_t>(length)};
        for (std::size_t i = 0; i < length; i += 2)
            all.push_back(static_cast<std::uint16_t>(a.log[i] | (i + 1 < length ? a.log[i + 1] << 8 : 0)));
        return is<modbus::get_comm_event_log>() && store(all);
    }
    bool operator()(const modbus::server_id_read& a) const
    {
        const auto byte = [&](std::size_t i) {
            return i < a.data.size() ? std::uint16_t{a.data[i]} : std::uint16_t{0};
        };
        return is<modbus::report_server_id>() && store({byte(0), byte(1)});
    }
    bool operator()(const modbus::written&) const { return !asked.target; }
    bool operator()(const modbus::no_response&) const { return true; }  // a broadcast, or "force listen only"
    bool operator()(const modbus::exception_code&) const { return false; }
    bool operator()(const modbus::device_identification_read&) const { return false; }

private:
    template <class Question>
    bool is() const
    {
        return std::holds_alternative<Question>(asked.request);
    }

    std::optional<std::size_t> registers_asked() const
    {
        if (const auto* both = std::get_if<modbus::read_write_multiple_registers>(&asked.request))
            return both->read_count;
        const auto* read = std::get_if<modbus::read_table>(&asked.request);
        if (read == nullptr || is_bit_table(read->from))
            return std::nullopt;
        return read->count;
    }

    bool store(const values& all) const
    {
        for (std::size_t i = 0; asked.target && i < all.size(); ++i)
            devices.set_word({asked.target->area, asked.target->bit + 16 * i}, all[i]);
        return asked.target.has_value();
    }
};

}  // namespace

bool store_answer(const adprw_command& asked, const modbus::response& answer, memory& devices)
{
    return std::visit(storer{asked, devices}, answer);
}

}  // namespace plcgw::plc
