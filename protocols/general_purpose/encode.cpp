#include "protocols/general_purpose/encode.hpp"

namespace plcgw::general_purpose {
namespace {

void append_end_code(buffer& to, end_code end)
{
    switch (end) {
    case end_code::cr: to.push_back(ascii::carriage_return); return;
    case end_code::cr_lf: to.insert(to.end(), {ascii::carriage_return, ascii::line_feed}); return;
    case end_code::etx: to.push_back(ascii::etx); return;
    case end_code::silence: return;
    }
}

}  // namespace

result<buffer> encode(bytes content, const message_form& form, ending how)
{
    if (content.size() > max_message_size)
        return make_error_code(errc::bad_count);
    buffer message;
    message.reserve(content.size() + 3);
    if (form.start == start_code::stx)
        message.push_back(ascii::stx);
    message.insert(message.end(), content.begin(), content.end());
    if (how == ending::with_end_code)
        append_end_code(message, form.end);
    if (message.empty() || message.size() > max_message_size)
        return make_error_code(errc::bad_count);
    return message;
}

}  // namespace plcgw::general_purpose
