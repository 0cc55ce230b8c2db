#include "protocols/errc.hpp"
#include "tests/support/print.hpp"

#include <set>

TEST_SUITE_BEGIN("serial");

using namespace plcgw;

TEST_CASE("errc: every error says something of its own")
{
    const errc all[] = {errc::bad_checksum,      errc::bad_header,     errc::incomplete,  errc::timed_out,
                        errc::unexpected_answer, errc::line_not_quiet, errc::port_absent, errc::bad_parity,
                        errc::bad_stop_bit,      errc::overrun,        errc::restarted,   errc::bad_count,
                        errc::not_expressible};
    std::set<std::string> texts{"unknown error"};
    for (const errc each : all) {
        const boost::system::error_code code = each;
        CHECK(code);
        CHECK(code == each);
        CHECK(std::string(code.category().name()) == "plc-gateway");
        CHECK_MESSAGE(texts.insert(code.message()).second, code.message());
    }
    CHECK(boost::system::error_code(99, protocol_category()).message() == "unknown error");
}

TEST_SUITE_END();
