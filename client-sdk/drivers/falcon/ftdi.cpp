#include "client-sdk/drivers/falcon/ftdi.hpp"

#include <vector>

#include "client-sdk/drivers/vendor_library.hpp"

namespace mechane::drivers::falcon {

std::string load(Ftdi& ftdi, const std::string& file) {
  VendorLibrary library;
  const std::vector<std::string> installed = {"libftdi1.so.2"};
  if (std::string fault = library.load(file, installed); !fault.empty())
    return fault + ". On Debian it is the package libftdi1-2";
  library.need(ftdi.make, "ftdi_new");
  library.need(ftdi.free, "ftdi_free");
  library.need(ftdi.open, "ftdi_usb_open_desc_index");
  library.need(ftdi.close, "ftdi_usb_close");
  library.need(ftdi.reset, "ftdi_usb_reset");
  library.need(ftdi.flush, "ftdi_tcioflush");
  library.need(ftdi.baud_rate, "ftdi_set_baudrate");
  library.need(ftdi.line, "ftdi_set_line_property");
  library.need(ftdi.flow_control, "ftdi_setflowctrl");
  library.need(ftdi.dtr, "ftdi_setdtr");
  library.need(ftdi.rts, "ftdi_setrts");
  library.need(ftdi.latency, "ftdi_set_latency_timer");
  library.need(ftdi.modem, "ftdi_poll_modem_status");
  library.need(ftdi.read, "ftdi_read_data");
  library.need(ftdi.write, "ftdi_write_data");
  library.need(ftdi.error, "ftdi_get_error_string");
  return library.missing();
}

}  // namespace mechane::drivers::falcon
