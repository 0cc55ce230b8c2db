#include "protocols/general_purpose/marked_characters.hpp"
#include "tests/support/messages.hpp"

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::general_purpose;
using namespace plcgw::test;

namespace {

// Characters as they are, <!> for a damaged one.
std::string shown(marked_characters& marks, bytes received)
{
    std::string all;
    for (const auto& each : marks.feed(received)) {
        if (const auto* characters = std::get_if<buffer>(&each))
            all.append(characters->begin(), characters->end());
        else {
            CHECK(std::get<errc>(each) == errc::bad_parity);
            all += "<!>";
        }
    }
    return all;
}

}  // namespace

TEST_CASE("marks: a damaged character is told where it stood, and FF is FF, at every cut")
{
    struct row {
        buffer received;
        std::string expected;
    };
    const row rows[] = {
        {{'A', 'B'}, "AB"},
        {{'A', 0xFF, 0x00, 'x', 'B'}, "A<!>B"},
        {{0xFF, 0xFF}, "\xFF"},
        {{0xFF, 0xFF, 0x00, 'A'}, std::string("\xFF\0A", 3)},
        {{0xFF, 0x00, 0xFF, 0xFF, 0x00, 0x00, 'A'}, "<!><!>A"},  // the damaged one was FF, then 00 (a break)
        {{0x00, 'A'}, std::string("\0A", 2)},
    };
    for (const row& each : rows) {
        for (std::size_t cut = 0; cut <= each.received.size(); ++cut) {
            marked_characters marks(errc::bad_parity);
            const bytes all(each.received);
            const std::string first = shown(marks, all.first(cut));
            CHECK(first + shown(marks, all.subspan(cut)) == each.expected);
        }
    }
}
