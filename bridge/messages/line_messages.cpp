#include "bridge/messages/line_messages.hpp"

#include "protocols/general_purpose/encode.hpp"

#include <algorithm>

namespace plcgw::messages {
namespace {

using general_purpose::receive_buffers;

constexpr std::size_t longest_shown = 200;  // bytes of a message in the log

void put(const plc_block& where, const_words words)
{
    for (std::size_t i = 0; i < words.size(); ++i)
        where.plc->memory().set_word({where.at.area, where.at.bit + 16 * i}, words[i]);
}

std::string and_more(unsigned dropped)
{
    return dropped == 0 ? std::string() : " (and " + std::to_string(dropped) + " more since the last report)";
}

}  // namespace

line_messages::line_messages(line_options options) : options_(std::move(options)), in_(options_.form) {}

void line_messages::add(raw_row row)
{
    receive_buffers buffers(row.policy);
    raws_.push_back({std::move(row), std::move(buffers), {}});
}

void line_messages::add(send_row row)
{
    // One source for both: a message is not sent twice for one cause.
    if (row.period > duration{})
        schedule_.add_periodic(row.period);
    else
        schedule_.add_triggered();
    if (row.trigger.plc != nullptr)
        schedule_.trigger(sends_.size(), row.trigger.level(), {});
    sends_.push_back({std::move(row)});
}

void line_messages::add(message_row row)
{
    message_reader reader(row.form, row.fields);
    routes_.push_back({std::move(row), std::move(reader), {}, {}});
}

void line_messages::reset_by(plc_bit bit)
{
    reset_ = bit;
    reset_level_ = bit.level();
}

std::optional<line_messages::question> line_messages::next(time_point now, wall_time wall)
{
    work_due_ = false;
    if (std::exchange(reset_due_, false))
        reset_channel();
    for (raw& each : raws_)
        fill(each, now, wall);
    show_status();
    while (now >= quiet_until_) {
        const auto source = schedule_.next(now);
        if (!source)
            return std::nullopt;
        if (!begin_ordered(*source)) {
            schedule_.finished(*source);
            continue;
        }
        const send_row& row = sends_[*source].row;
        auto content = content_of(row);
        auto message = content ? general_purpose::encode(content->content, options_.form, content->how)
                               : result<buffer>(content.error());
        if (message) {
            question q{*source, std::move(content->content), std::move(*message), row.answer, options_.timing};
            q.timing.response_timeout = row.response_timeout;
            return q;
        }
        news_.bad_send_count = true;
        not_answered(*source, message.error().message());
        schedule_.finished(*source);
        ordered_ended(*source, now, "cannot send it: " + message.error().message());
    }
    return std::nullopt;
}

result<outgoing> line_messages::content_of(const send_row& row) const
{
    if (row.words.plc == nullptr)
        return outgoing{row.text, general_purpose::ending::with_end_code};
    std::vector<std::uint16_t> area(row.words.count);
    row.words.plc->memory().read(row.words.at, area);
    return message_in(area);
}

time_point line_messages::wake_at() const
{
    if (work_due_)
        return {};
    time_point soonest = std::max(schedule_.wake_at(), quiet_until_);
    for (const raw& each : raws_)
        soonest = std::min(soonest, each.stands.wake_at(options_.longest_silence, {}));
    for (const route& each : routes_)
        soonest = std::min(soonest, each.stands.wake_at(options_.longest_silence, each.row.longest_silence));
    return soonest;
}

void line_messages::sent(const question& q, wall_time wall)
{
    ++sent_;
    show_status();
    messages_.push_back({name(), message_direction::sent, sends_[q.send].row.name, {}, q.content, wall});
}

void line_messages::answered(const question& q, const buffer& answer, time_point now, wall_time wall)
{
    schedule_.finished(q.send);
    ordered_ended(q.send, now, {});
    if (std::exchange(sends_[q.send].failing, false))
        note(line_event::severity::info, "send.answered", sends_[q.send].row.name,
             label("send", sends_[q.send].row.name) + " is answered again");
    if (q.answer == general_purpose::expect::message)
        take(answer, q.send, now, wall);
    show_status();
}

void line_messages::failed(const question& q, boost::system::error_code why, time_point now, unsigned attempts)
{
    schedule_.finished(q.send);
    ordered_ended(q.send, now, "did not send it: " + why.message());
    not_answered(q.send, why.message());
    if (attempts > 0)
        quiet_until_ = now + attempts * q.timing.response_timeout;
}

void line_messages::given_up(const question& q, time_point now, unsigned attempts)
{
    schedule_.finished(q.send);
    ordered_ended(q.send, now, "was reset while the message was sent");
    if (attempts > 0 && q.answer == general_purpose::expect::message)
        quiet_until_ = now + attempts * q.timing.response_timeout;
}

void line_messages::not_answered(std::size_t send, const std::string& why)
{
    ++unanswered_;
    show_status();
    if (!std::exchange(sends_[send].failing, true))
        note(line_event::severity::warning, "send.failed", sends_[send].row.name,
             label("send", sends_[send].row.name) + " fails: " + why);
    for (route& each : routes_)
        if (each.brought_by == send)
            each.stands.lose();
}

void line_messages::received(result<buffer> what, time_point now, wall_time wall)
{
    if (what) {
        take(*what, std::nullopt, now, wall);
        show_status();
        return;
    }
    const auto why = static_cast<errc>(what.error().value());
    port_.add(what);
    for (raw& each : raws_)
        each.buffers.add(what);
    if (why != errc::restarted)
        if (const auto dropped = damages_.admit(now))
            note(line_event::severity::warning, "message.damaged", name(),
                 "line " + name() + ": a message was dropped: " + what.error().message() + and_more(*dropped));
    show_status();
}

void line_messages::take(const buffer& message, std::optional<std::size_t> answer_to, time_point now, wall_time wall)
{
    ++received_;
    for (raw& each : raws_) {
        each.buffers.add(message);
        fill(each, now, wall);
        look_at_buffers(each);
    }
    serial_message said{name(), message_direction::received, {}, {}, message, wall};
    std::string why = "it is no answer, and all patterns are for answers";
    for (route& each : routes_) {
        const std::string& wanted = each.row.answer_to;
        if (!wanted.empty() && (!answer_to || sends_[*answer_to].row.name != wanted))
            continue;
        if (read(each, message, answer_to, now, wall)) {
            said.name = each.row.name;
            break;
        }
        why = each.row.name + ": " + each.reader.last_refused()->reason;
    }
    if (said.name.empty() && !routes_.empty()) {
        said.reason = why;
        refuse(message, why, now);
    }
    messages_.push_back(std::move(said));
}

bool line_messages::read(route& by, const buffer& message, std::optional<std::size_t> answer_to, time_point now,
                         wall_time wall)
{
    const std::vector<field>& fields = by.reader.fields();
    std::vector<std::uint16_t> before;
    for (std::size_t i = 0; i < fields.size(); ++i)
        before.insert(before.end(), by.reader.words_of(i).begin(), by.reader.words_of(i).end());
    if (!by.reader.read(message))
        return false;
    auto old = before.begin();
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const const_words fresh = by.reader.words_of(i);
        if (!std::equal(fresh.begin(), fresh.end(), old))
            by.stands.change();
        old += static_cast<std::ptrdiff_t>(fresh.size());
        put(by.row.into[i], fresh);
    }
    by.brought_by = answer_to;
    news_.copied = true;
    if (by.stands.state() == quality::comm_error || by.stands.state() == quality::stale)
        note(line_event::severity::info, "message.back", by.row.name, label("message", by.row.name) + " comes again");
    by.stands.renew(now, wall);
    return true;
}

void line_messages::refuse(const buffer& message, const std::string& reason, time_point now)
{
    ++refused_;
    if (const auto dropped = refusals_.admit(now))
        note(line_event::severity::warning, "message.refused", name(),
             "line " + name() + ": no pattern takes the message " + printable(message, longest_shown) + ": " + reason +
                 and_more(*dropped));
}

// What GPRECV does, as long as the reader took the message before.
void line_messages::fill(raw& of, time_point now, wall_time wall)
{
    std::vector<std::uint16_t> area(of.row.into.count);
    while (!of.row.ready.level()) {
        const auto message = of.buffers.take();
        if (!message)
            break;
        const auto size = store_message(*message, area);
        if (!size) {
            ++too_long_;
            if (const auto dropped = damages_.admit(now))
                note(line_event::severity::warning, "message.too_long", of.row.into.name,
                     label("received", of.row.into.name) + ": a message of " + std::to_string(message->size()) +
                         " bytes does not fit into " + std::to_string(area.size()) + " words" + and_more(*dropped));
            continue;
        }
        put(of.row.into, const_words(area).first(*size));
        news_.copied = true;
        if (of.row.ready.plc != nullptr)
            of.row.ready.plc->memory().set_bit(of.row.ready.at, true);
        of.stands.renew(now, wall);
        of.stands.change();
    }
    if (of.buffers.waiting() == 0 && !of.buffers.stopped())
        of.said_full = false;
}

void line_messages::look_at_buffers(raw& of)
{
    const bool full = of.buffers.waiting() == receive_buffers::size || of.buffers.stopped();
    const bool lost = (of.buffers.error_code() & general_purpose::receive_error::buffers_full) != 0;
    if (!full || !lost || std::exchange(of.said_full, true))
        return;
    note(line_event::severity::warning, "message.buffers_full", of.row.into.name,
         label("received", of.row.into.name) + ": all eight buffers are full, messages are lost until " +
             (of.buffers.stopped() ? "the channel is reset" : "the reader clears the ready bit"));
}

}  // namespace plcgw::messages
