// 512-bit integers on the stack, for numbers known beforehand to fit. What is decided in them counts as the
// filter's level 1.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

namespace touchstone::referee {

using Short = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<512, 512, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, void>,
    boost::multiprecision::et_off>;

}  // namespace touchstone::referee
