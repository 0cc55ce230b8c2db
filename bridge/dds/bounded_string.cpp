#include "bridge/dds/bounded_string.hpp"

#include <algorithm>

namespace plcgw {

void fill_string(std::span<char> out, std::string_view text)
{
    if (out.empty())
        return;

    text = text.substr(0, text.find('\0'));
    std::size_t size = std::min(text.size(), out.size() - 1);

    // A UTF-8 character has at most three continuation bytes; more of them are not UTF-8 and are cut anywhere.
    const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U; };
    if (size < text.size()) {
        std::size_t start = size;
        while (start > 0 && size - start < 3 && continues(start))
            --start;
        if (!continues(start))
            size = start;
    }

    std::copy_n(text.begin(), size, out.begin());
    out[size] = '\0';
}

std::string_view read_string(std::span<const char> in)
{
    const auto end = std::find(in.begin(), in.end(), '\0');
    return {in.data(), static_cast<std::size_t>(end - in.begin())};
}

}  // namespace plcgw
