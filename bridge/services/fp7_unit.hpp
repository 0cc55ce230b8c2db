// The built-in communication unit of an FP7 CPU as the PLC's program sees it: the contacts X0-X14 and Y0-Y14 of FP7
// manual 4.1.1, the words of PMGET (10.3.2), and the channel reset by Y10, Y11 or Y12 (9.4.3, 10.4.1).
//
//     who              COM.1  COM.2  COM.0                               who              COM.1  COM.2  COM.0
//     message waits    X0     X1     X2                                  sending failed   Y0     Y1     Y2
//     message copied   X4     X5     X6                                  sending, general Y8     Y9     YA
//     general-purpose  X8     X9     XA                                  sending, master  YC     YD     YE
//     master           XC     XD     XE                                  reset, request   Y10    Y11    Y12
//     reset done       X10    X11    X12                                 RTS              Y14
//     CTS              X14
//     PMGET            UM100  UM200  UM0: 26 words of parameters, and 50 behind that 7 words of monitor information
//
// A line uses it like this: open() once; show(), note() and copied() as things happen; run() after the memory changed
// and at the deadline. What run() returns was asked to be reset: stop sending and receiving, then reset_done().
//
// A simulated PLC has no scan of its own. What the manual lets stand for one scan stands for `scan`.
#pragma once

#include "bridge/plc/pmget.hpp"
#include "bridge/plc/simulated_plc.hpp"

#include <map>

namespace plcgw {

// What a line knows of its port at this moment.
struct com_state {
    bool message_waits = false;  // received and not yet copied to memory
    bool sending = false;        // of a general-purpose port or a master: not the answers of a server
    bool send_failed = false;    // how the last sending ended
    bool cts_off = false;        // the other side forbids to send; COM.1 with RS/CS
    bool operator==(const com_state&) const = default;
};

class fp7_unit {
public:
    // Throws std::invalid_argument when the PLC is no FP7.
    explicit fp7_unit(plc::simulated_plc& plc, duration scan = std::chrono::milliseconds(10));

    // The line stands for this port, COM.0 to COM.2; else std::out_of_range, here and below for a port never opened.
    void open(time_point now, unsigned com, const plc::com_parameters& set, plc::com_card card);

    void show(time_point now, unsigned com, const com_state& state);
    void sends(time_point now, unsigned com, time_point until);  // what is sent has left by then; for a scan at least
    void copied(time_point now, unsigned com);  // GPRECV put a message into devices: X4 stands for a scan
    void note(unsigned com, plc::receive_error what);
    void note(unsigned com, plc::setting_error what, std::uint16_t wrong_parameter = 0);
    const plc::com_monitor& monitor(unsigned com) const { return ports_.at(com).monitor; }

    // Follows Y10-Y12, power cycles, RUN and STOP, and ends what stood for a scan. Returns the ports whose request rose
    // since the last call. Contacts that somebody else wrote are put right.
    std::vector<unsigned> run(time_point now);

    // Sending and receiving have ended. Errors are cleared, the state is that of a port just opened, and X10 stands as
    // long as the request does.
    void reset_done(time_point now, unsigned com);

    // Y14: the other side is forbidden to send. False for other ports than COM.1.
    bool rts_off(unsigned com) const;

    // When run() is due although nothing was written; nothing: never.
    std::optional<time_point> deadline() const;

private:
    struct port {
        plc::com_parameters set;
        plc::com_monitor monitor;
        com_state state;
        std::optional<time_point> copied_until;
        std::optional<time_point> sending_until;  // the flag stands for a scan at least
        bool requested = false;                   // level of Y10 at the last run()
        bool done = false;                        // X10
    };

    void write_contacts(unsigned com, const port& p);
    void write_words(unsigned com, const port& p);
    void set(plc::device_kind kind, unsigned number, bool on);
    bool is_set(plc::device_kind kind, unsigned number) const;

    plc::simulated_plc* plc_;
    duration scan_;
    std::map<unsigned, port> ports_;  // by COM number
    unsigned power_ons_;
};

}  // namespace plcgw
