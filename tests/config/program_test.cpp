// Setup programs: in the configuration, and in a file beside it.
#include "daemon/config/program_file.hpp"
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>

TEST_SUITE_BEGIN("check");

using namespace plcgw::config;

namespace {

// A folder that is gone afterwards.
struct temporary_folder {
    temporary_folder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "plcgw-config-XXXXXX").string();
        REQUIRE(::mkdtemp(name.data()) != nullptr);
        path = name;
    }
    ~temporary_folder() { std::filesystem::remove_all(path); }
    temporary_folder(const temporary_folder&) = delete;
    temporary_folder& operator=(const temporary_folder&) = delete;

    void write(const std::filesystem::path& name, std::string_view text) const
    {
        std::filesystem::create_directories((path / name).parent_path());
        std::ofstream(path / name) << text;
    }

    std::filesystem::path path;
};

std::string with_file(const std::string& name)
{
    return "{\"plcs\": [\n{\"name\": \"a\",\n\"program_file\": \"" + name + "\"}]}";
}

}  // namespace

TEST_CASE("check: mistakes of a setup program stand on their line")
{
    const change_row rows[] = {
        {"\"MOV K0 D8471\"", "\"MOVE K0 D8471\"",
         "9 /plcs/0/program/2 unknown instruction \"MOVE\": a program holds LD, MOV, ADPRW and END"},
        {"\"MOV K0 D8471\"", "\"MOV K0\"",
         "9 /plcs/0/program/2 MOV takes a constant and a device, for example MOV K10 D8411"},
        {"\"MOV K0 D8471\"", "\"MOV K70000 D8471\"",
         "9 /plcs/0/program/2 K70000 is no constant: K-32768 to K65535 or H0 to HFFFF"},
        {"\"MOV K0 D8471\"", "\"MOV K0 D100\"",
         "9 /plcs/0/program/2 D100 is no MODBUS setting: D8400-D8439 and D8470-D8485 are"},
        {"\"LD M8411\"", "\"; nothing\"",
         "8 /plcs/0/program/1 MOV stands above LD M8411\n9 /plcs/0/program/2 MOV stands above LD M8411"},
        {"\"LD M8411\"", "\"LD\"",
         "7 /plcs/0/program/0 LD takes one device, for example LD M8411\n"
         "8 /plcs/0/program/1 MOV stands above LD M8411\n9 /plcs/0/program/2 MOV stands above LD M8411"},
        {"\"MOV K0 D8471\"", "\"\", \"  ; comment\",\n\n\"MOVE\"",
         "11 /plcs/0/program/4 unknown instruction \"MOVE\": a program holds LD, MOV, ADPRW and END"},
        {"\"MOV K0 D8471\"", "\"MOV K0 D8471\\nMOVE\"",
         "9 /plcs/0/program/2 is \"MOV K0 D8471\\nMOVE\", expected a text without line breaks and control characters"},
        {"\"MOV K0 D8471\"", "\"MOV\\tK0\\tD8471\\t; tabs\"", ""},
    };
    for (const change_row& row : rows)
        check_row(row);
}

TEST_CASE("check: what the PLC refuses is a warning, the gateway runs as the PLC would")
{
    const change_row rows[] = {
        {"\"MOV K0 D8471\"", "\"MOV K7990 D8471\"",
         "8 warning /plcs/0/program/1 D7990-D8245 exceeds the range of this PLC, which ends at D7999"},
        {"\"MOV K0 D8471\"", "\"MOV K0 D8471\", \"MOV K40000 D8409\"",
         "9 warning /plcs/0/program/3 D8409 = 40000 is not within 0 to 32767"},
        {"\"MOV K0 D8471\"", "\"MOV D0 D8471\"", "9 warning /plcs/0/program/2 the source D0 is no constant"},
    };
    for (const change_row& row : rows) {
        const loaded result = load_text(changed(row.from, row.to), {});
        INFO(said(result.found));
        CHECK(result.found.size() == 1);
        CHECK_FALSE(has_errors(result.found));
        CHECK(said(result.found).starts_with(row.expected));
        CHECK(said(result.found).find("; the PLC runs without it and shows error 202 with detail 84") !=
              std::string::npos);
    }
}

TEST_CASE("check: program_file is relative to the configuration")
{
    const temporary_folder folder;
    folder.write("setup.txt", "LD M8411\nMOV K0 D8470\n");
    folder.write("programs/bad.txt", "LD M8411\r\n\r\nMOVE\r\nMOV K1\r\n");
    folder.write("fault.txt", "LD M8411\nMOV K40000 D8409\n");
    folder.write("empty.txt", "");
    folder.write("plant/gateway.json", with_file("../setup.txt"));

    CHECK(said(with_file("setup.txt"), folder.path) == "");
    CHECK(said(with_file((folder.path / "setup.txt").string()), "/nowhere") == "");
    CHECK(said(with_file("empty.txt"), folder.path) == "");
    CHECK(said(load_file(folder.path / "plant/gateway.json").found) == "");
    CHECK(said(with_file("setup.txt"), folder.path / "plant") ==
          "3 /plcs/0/program_file names \"setup.txt\", which cannot be read");
    CHECK(said(with_file("programs"), folder.path) ==
          "3 /plcs/0/program_file names \"programs\", which cannot be read");
    CHECK(
        said(with_file("programs/bad.txt"), folder.path) ==
        "3 /plcs/0/program_file programs/bad.txt line 3: unknown instruction \"MOVE\": a program holds LD, MOV, "
        "ADPRW and END\n"
        "3 /plcs/0/program_file programs/bad.txt line 4: MOV takes a constant and a device, for example MOV K10 D8411");
    CHECK(
        said(with_file("fault.txt"), folder.path) ==
        "3 warning /plcs/0/program_file fault.txt line 2: D8409 = 40000 is not within 0 to 32767; the PLC runs without "
        "it and shows error 202 with detail 8409 in D8402 and D8403");
    plcgw::plc_config plc;
    plc.program_file = "setup.txt";
    CHECK(program_text(plc, folder.path) == "LD M8411\nMOV K0 D8470\n");
}

TEST_CASE("check: program or program_file")
{
    const temporary_folder folder;
    folder.write("setup.txt", "LD M8411\n");
    CHECK(said(changed("\"model\": \"FX3U\",", "\"model\": \"FX3U\",\n\"program_file\": \"setup.txt\","),
               folder.path) == "6 /plcs/0/program_file stands beside \"program\": keep one of them");
}

TEST_CASE("check: files that cannot be read")
{
    const temporary_folder folder;
    CHECK(said(load_file(folder.path / "absent.json").found) == "0 cannot be read: No such file or directory");
    CHECK(said(load_file(folder.path).found) == "0 cannot be read: is a folder");
    folder.write("a.json", "{}");
    CHECK(said(load_file(folder.path / "a.json" / "b.json").found) == "0 cannot be read: Not a directory");
}

TEST_CASE("check: the hash tells two texts apart")
{
    CHECK(load_text("{}", {}).hash.size() == 16);
    CHECK(load_text("{}", {}).hash == load_text("{}", {}).hash);
    CHECK(load_text("{}", {}).hash != load_text("{ }", {}).hash);
}
