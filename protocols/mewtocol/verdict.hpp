// What a client's conversation says about a frame that it heard; shared by MEWTOCOL-COM and MEWTOCOL7-COM.
#pragma once

#include "protocols/bytes.hpp"
#include "protocols/errc.hpp"

#include <variant>

namespace plcgw::mewtocol {

struct not_the_answer {  // noise, our own echo, another station, a late answer: the answer may still come
    errc why{};          // 0: nothing is wrong with it
};

struct damaged_answer {  // no other one will come
    errc why{};
};

struct ask_on {  // the next frame of an answer in several
    buffer request;
};

template <class Answer>
struct not_now {    // the station executed nothing: our request was damaged, it is busy, or owes somebody an answer
    Answer answer;  // if it stays so
};

template <class Answer>
using verdict = std::variant<not_the_answer, damaged_answer, ask_on, not_now<Answer>, Answer>;

}  // namespace plcgw::mewtocol
