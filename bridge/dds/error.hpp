// Why DDS could not be set up: a sentence for the log. The caller may try again later, e.g. when an interface is back.
#pragma once

#include <boost/system/result.hpp>

#include <string>

namespace plcgw {

struct dds_error {
    std::string text;
};

template <class T>
using dds_result = boost::system::result<T, dds_error>;

}  // namespace plcgw
