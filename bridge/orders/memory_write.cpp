#include "bridge/orders/memory_write.hpp"

namespace plcgw {

memory_write::memory_write(const write_span& span) : span_(span), before_(bits_now()) {}

std::vector<bool> memory_write::bits_now() const
{
    std::vector<bool> bits(span_.bits);
    for (std::size_t i = 0; i < bits.size(); ++i)
        bits[i] = span_.plc->memory().bit({span_.at.area, span_.at.bit + i});
    return bits;
}

void memory_write::write(const order_values& values)
{
    plc::memory& memory = span_.plc->memory();
    for (std::uint32_t i = 0; i < values.count; ++i) {
        if (values.are_bits)
            memory.set_bit({span_.at.area, span_.at.bit + i}, values.bit(i));
        else
            memory.set_word({span_.at.area, span_.at.bit + std::size_t{16} * i}, values.words[i]);
    }
}

void memory_write::written()
{
    after_ = bits_now();
    others_ = span_.plc->memory().watch_writes(span_.at, span_.bits);
}

void memory_write::take_back()
{
    plc::memory& memory = span_.plc->memory();
    if (memory.take_written(others_) || bits_now() != after_)
        return;
    for (std::size_t i = 0; i < before_.size(); ++i)
        memory.put_bit({span_.at.area, span_.at.bit + i}, before_[i]);
}

void memory_write::end() { span_.plc->memory().end_watch(others_); }

}  // namespace plcgw
