// A search for stations on a line: which question comes next, and what the answers say of who is there. Each question
// is asked once. Knows no times: whoever asks decides when.
#pragma once

#include "bridge/routes/station_question.hpp"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace plcgw {

enum class scan_language : std::uint8_t { modbus, mewtocol };

// What one table or area said when its first register, bit, word or contact was read.
struct scanned_area {
    station_place first;
    enum class says : std::uint8_t { values, refused, nothing } what{};
    std::string reason{};  // "exception 02 (illegal data address)"; empty for values
};

struct scan_finding {
    station_number unit;
    // Of a damaged answer: something is there. Nothing more is asked of it.
    bool is_damaged = false;
    std::string damage{};          // why
    std::string identification{};  // functions 2B/0E or 11, printable characters only; empty: it tells nothing
    std::vector<scanned_area> areas{};
};

class station_scan {
public:
    station_scan(scan_language language, std::vector<station_number> units);

    struct question {
        station_number unit;
        station_question asked;
    };
    // Nothing while one is under way, and at the end. One of the next three calls ends a question.
    std::optional<question> next();
    bool waits() const { return !asking_ && !is_over(); }  // next() has one

    void answered(const station_answer& answer);
    void failed(const boost::system::error_code& why);
    void interrupted() { asking_ = false; }  // it is asked again

    bool is_over() const { return !asking_ && steps_.empty() && at_ >= units_.size(); }
    std::size_t units_asked() const { return at_; }
    std::size_t units_total() const { return units_.size(); }
    std::size_t questions() const { return questions_; }  // that ended
    std::size_t disturbed() const { return disturbed_; }  // units that were not asked: somebody else kept talking

    // In the order in which they were found.
    const std::vector<scan_finding>& found() const { return found_; }

private:
    // The first question to a unit reads something harmless: whoever is there answers it, if only by an exception. The
    // other ones follow when it did.
    struct step {
        station_question asked;
        std::optional<station_place> area;  // that it reads; none: it asks for identification
    };
    static std::vector<step> steps_for(scan_language language);

    void note(const step& of, const station_answer& answer);
    void end_step();

    scan_language language_;
    std::vector<station_number> units_;
    std::size_t at_ = 0;      // of the unit that is asked next, or now
    std::deque<step> steps_;  // more questions to the station that was found last
    bool asking_ = false;
    unsigned tries_ = 0;  // of a line that was not quiet
    std::size_t questions_ = 0;
    std::size_t disturbed_ = 0;
    std::vector<scan_finding> found_;
};

// What a device says of itself, for people and terminals: other characters become dots.
std::string printable(std::string_view text);

}  // namespace plcgw
