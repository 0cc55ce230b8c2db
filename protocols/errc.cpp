#include "protocols/errc.hpp"

#include <string>

namespace plcgw {
namespace {

class category final : public boost::system::error_category {
public:
    const char* name() const noexcept override { return "plc-gateway"; }
    std::string message(int value) const override
    {
        switch (static_cast<errc>(value)) {
        case errc::bad_checksum: return "bad checksum";
        case errc::bad_header: return "not a frame of this protocol";
        case errc::incomplete: return "incomplete frame";
        case errc::too_short: return "too short for a frame";
        case errc::overlong: return "longer than any frame";
        case errc::bad_character: return "character that is no hexadecimal digit";
        case errc::timed_out: return "no answer";
        case errc::unexpected_answer: return "answer does not fit the question";
        case errc::collision: return "own request came back changed";
        case errc::line_not_quiet: return "line not quiet";
        case errc::port_absent: return "port absent";
        case errc::bad_parity: return "parity error";
        case errc::bad_stop_bit: return "framing error";
        case errc::overrun: return "characters lost, the port was read too late";
        case errc::restarted: return "a new frame or message began inside this one";
        case errc::not_expressible: return "not expressible in this protocol";
        case errc::bad_count: return "number of bytes cannot be sent";
        }
        return "unknown error";
    }
};

}  // namespace

const boost::system::error_category& protocol_category() noexcept
{
    static const category instance;
    return instance;
}

}  // namespace plcgw
