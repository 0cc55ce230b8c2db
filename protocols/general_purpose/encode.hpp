// A message as it is sent on a general-purpose line: FP7 serial communication manual 9.3.2 and 9.3.4.
#pragma once

#include "protocols/bytes.hpp"
#include "protocols/errc.hpp"
#include "protocols/general_purpose/message_form.hpp"

namespace plcgw::general_purpose {

enum class ending : std::uint8_t { with_end_code, without_end_code };

// Adds the start code and the end code of the line. errc::bad_count: nothing to send, or more than max_message_size
// bytes with the codes. Codes inside the content are sent as they are.
//
// The send wait time (9.2.1, 0 to 100 ms) is exchange_options::send_wait.
result<buffer> encode(bytes content, const message_form& form, ending how = ending::with_end_code);

}  // namespace plcgw::general_purpose
