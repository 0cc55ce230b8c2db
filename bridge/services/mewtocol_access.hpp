// What MEWTOCOL commands need of a device. The answers are those of a PLC: 60 for an area that it does not have, 61 for
// a number beyond the area, 63 and 65 where mode or protection forbid it.
#pragma once

#include "protocols/mewtocol/mewtocol7_message.hpp"
#include "protocols/mewtocol/response.hpp"

#include <span>

namespace plcgw {

class mewtocol_access {
public:
    template <class T>
    using answer = boost::system::result<T, mewtocol::error_code>;
    using refusal = std::optional<mewtocol::error_code>;  // nothing = done

    virtual ~mewtocol_access() = default;

    // Ranges are never empty. Nothing is written unless all of it can be.
    virtual answer<std::vector<std::uint16_t>> read_words(mewtocol::word_area from, std::uint32_t first,
                                                          std::uint32_t count) const = 0;
    virtual refusal write_words(mewtocol::word_area to, std::uint32_t first, std::span<const std::uint16_t> values) = 0;
    virtual answer<bool> read_contact(const mewtocol::contact& at) const = 0;
    virtual refusal write_contacts(std::span<const mewtocol::contact_value> values) = 0;

    // Words that a range of this area has, so that a range far beyond it costs no memory. 0: no such area.
    virtual std::uint32_t words_in(mewtocol::word_area area) const = 0;

    virtual mewtocol::plc_status status() const = 0;  // RT
    // EX00RT and STRD. Not every device has them: 42.
    virtual answer<mewtocol::extended_status_read> extended_status() const
    {
        return mewtocol::error_code::not_supported;
    }
    virtual answer<mewtocol7::state_read> state() const { return mewtocol::error_code::not_supported; }
    virtual refusal change_mode(mewtocol::operating_mode to) = 0;  // RM

    virtual std::uint64_t scans() const = 0;  // since power-on: MG tells how many passed since the last MG

protected:
    mewtocol_access() = default;
    mewtocol_access(const mewtocol_access&) = default;
    mewtocol_access& operator=(const mewtocol_access&) = default;
};

}  // namespace plcgw
