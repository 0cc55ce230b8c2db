// The port of a simulated FP7: to whom it listens, what it checks, and how it splits long answers (FP7 serial
// communication manual, 11.2).
#pragma once

#include "tests/field/fp7_memory.hpp"
#include "tests/field/mewtocol_frame.hpp"

namespace plcgw::field {

class fp7_station {
public:
    fp7_station(unsigned number, fp7_memory& memory);  // 1 to 99

    // The answer with its CR; nothing if there is none. EE is answered too, FF (all) is only executed.
    std::string hear(const heard_frame& frame);

private:
    std::string judge(const heard_frame& frame);  // the answer from its mark on, without check
    std::string obey(char header, std::string_view command);
    std::string next_piece();

    std::string number_;
    fp7_memory& memory_;
    std::string rest_;   // of an answer in several frames, until it is fetched
    bool more_ = false;  // the frame that hear() returns is not the answer's last
};

}  // namespace plcgw::field
