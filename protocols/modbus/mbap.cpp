#include "protocols/modbus/mbap.hpp"

#include "protocols/modbus/wire.hpp"

namespace plcgw::modbus {

void mbap_framer::feed(bytes received)
{
    received_.erase(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(consumed_));
    consumed_ = 0;
    received_.insert(received_.end(), received.begin(), received.end());
}

std::optional<result<tcp_frame>> mbap_framer::next()
{
    const bytes rest = bytes(received_).subspan(consumed_);
    // Each field is judged as soon as it is there: a stranger who sends "GET /" is noticed at once.
    if (rest.size() >= 4 && read_word(rest, 2) != 0)
        return make_error_code(errc::bad_header);
    if (rest.size() < 6)
        return std::nullopt;
    const std::size_t length = read_word(rest, 4);  // unit id and PDU
    if (length < 2 || length > 1 + max_pdu_size)
        return make_error_code(errc::bad_header);
    if (rest.size() < 6 + length)
        return std::nullopt;

    const bytes pdu = rest.subspan(mbap_size, length - 1);
    consumed_ += 6 + length;
    return tcp_frame{transaction_id{read_word(rest, 0)}, {unit_id{rest[6]}, buffer(pdu.begin(), pdu.end())}};
}

void append_mbap(buffer& to, const tcp_frame& f)
{
    append_word(to, static_cast<std::uint16_t>(f.id));
    append_word(to, 0);
    append_word(to, static_cast<std::uint16_t>(1 + f.content.pdu.size()));
    to.push_back(static_cast<std::uint8_t>(f.content.unit));
    to.insert(to.end(), f.content.pdu.begin(), f.content.pdu.end());
}

}  // namespace plcgw::modbus
