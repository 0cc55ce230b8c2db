#include "bridge/messages/message_reader.hpp"

#include <algorithm>
#include <utility>

namespace plcgw::messages {
namespace {

constexpr std::size_t longest_shown = 256;  // bytes

std::size_t index_of(const pattern& p, const std::string& name)
{
    return static_cast<std::size_t>(std::find(p.names().begin(), p.names().end(), name) - p.names().begin());
}

std::optional<std::string> mistake_of(const pattern& p, const field& f)
{
    const std::size_t index = index_of(p, f.name);
    if (index == p.names().size())
        return "the pattern has no field of the name " + f.name;
    if (f.type == value_type::text) {
        if (f.characters == 0 || f.characters > general_purpose::max_message_size)
            return "field " + f.name + ": text needs room for 1 to 4096 characters";
        return std::nullopt;
    }
    if (!is_number(p.form_of(index)))
        return "field " + f.name + " is text in the pattern, its type must be text";
    if (f.decimals < -most_decimals || f.decimals > most_decimals)
        return "field " + f.name + ": decimals must be -9 to 9";
    return std::nullopt;
}

}  // namespace

std::vector<std::string> mistakes_of(const pattern& p, const std::vector<field>& fields)
{
    std::vector<std::string> all;
    for (const field& each : fields)
        if (auto mistake = mistake_of(p, each))
            all.push_back(std::move(*mistake));
    return all;
}

message_reader::message_reader(pattern p, std::vector<field> fields)
    : pattern_(std::move(p)), fields_(std::move(fields)), first_{0}
{
    for (const field& each : fields_) {
        captures_.push_back(index_of(pattern_, each.name));
        first_.push_back(first_.back() + registers_of(each));
    }
    words_.resize(first_.back());
    fresh_.resize(first_.back());
}

bool message_reader::read(bytes message)
{
    const auto captures = pattern_.match(message);
    if (!captures) {
        ++counters_.unmatched;
        refuse(message, to_string(captures.error()));
        return false;
    }
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const words into = words(fresh_).subspan(first_[i], first_[i + 1] - first_[i]);
        const capture& value = (*captures)[captures_[i]];
        if (const auto fault = store(fields_[i], value, into)) {
            ++counters_.unfit;
            refuse(message, fields_[i].name + " " + std::string(to_string(*fault)));
            return false;
        }
    }
    ++counters_.matched;
    std::swap(words_, fresh_);
    return true;
}

const_words message_reader::words_of(std::size_t index) const
{
    return const_words(words_).subspan(first_[index], first_[index + 1] - first_[index]);
}

void message_reader::refuse(bytes message, std::string reason)
{
    last_refused_ = refused_message{printable(message, longest_shown), std::move(reason)};
}

}  // namespace plcgw::messages
