// Devices that an order writes, until its outcome is known: an order that does not begin in time has no effect.
#pragma once

#include "bridge/orders/order.hpp"
#include "bridge/plc/simulated_plc.hpp"

namespace plcgw {

// A run of devices that somebody wants to write.
struct write_span {
    plc::simulated_plc* plc = nullptr;
    plc::place at;
    std::size_t bits = 0;
};

class memory_write {
public:
    explicit memory_write(const write_span& span);  // before they are written

    void write(const order_values& values);  // as many as the span has; or whoever else knows how, then:
    void written();                          // from now on others are noticed

    // They are as they were before, unless somebody else wrote or changed them meanwhile. No sign of life of who
    // writes.
    void take_back();
    void end();  // once written() was called: nobody is watched any more

    const write_span& span() const { return span_; }
    plc::change change() const { return {span_.at.area, span_.at.bit, span_.bits}; }

private:
    std::vector<bool> bits_now() const;

    write_span span_;
    std::vector<bool> before_;
    std::vector<bool> after_;
    plc::memory::watch others_{};
};

}  // namespace plcgw
