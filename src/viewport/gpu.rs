//! The graphics adapter: which one, and what to say when there is none.

use std::convert::Infallible;
use std::fmt;
use std::str::FromStr;
use std::sync::{Arc, Mutex, PoisonError};

/// Which graphics adapter draws.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum AdapterChoice {
    /// The system's best: a discrete one before an integrated one before a software one.
    #[default]
    System,
    /// One that draws on the processor.
    Software,
    /// The first whose name contains this, in upper or lower case.
    Named(String),
}

impl FromStr for AdapterChoice {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        Ok(match text {
            "system" => Self::System,
            "software" => Self::Software,
            name => Self::Named(name.to_owned()),
        })
    }
}

impl fmt::Display for AdapterChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::System => "system",
            Self::Software => "software",
            Self::Named(name) => name,
        })
    }
}

/// Why nothing can be drawn.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    #[error(
        "no graphics adapter was found; a driver that draws on the processor will do: \
         on Debian and Ubuntu `apt install mesa-vulkan-drivers libvulkan1`"
    )]
    NoAdapter,
    #[error("no graphics adapter is `{wanted}` (found: {known})")]
    NoSuchAdapter { wanted: AdapterChoice, known: String },
    #[error("the graphics adapter `{adapter}` refused to open")]
    Refused { adapter: String, source: wgpu::RequestDeviceError },
    #[error("the graphics device failed: {0}")]
    Failed(String),
    #[error(
        "a picture of {width} x {height} pixels is not possible: this graphics adapter draws 1 to {limit} each way"
    )]
    PictureSize { width: u32, height: u32, limit: u32 },
}

/// An open graphics device. Clones share it.
#[derive(Clone, Debug)]
pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    /// The first failure that no caller was told of yet.
    failure: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// Opens an adapter for drawing without a window.
    ///
    /// # Errors
    /// If there is no adapter, none that matches, or it does not open.
    pub fn new(choice: &AdapterChoice) -> Result<Self, GpuError> {
        // Only what is asked for below: OpenGL would look for a display and complain.
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        descriptor.backends &= wgpu::Backends::PRIMARY;
        let instance = wgpu::Instance::new(descriptor);
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
        let infos: Vec<_> = adapters.iter().map(wgpu::Adapter::get_info).collect();
        let chosen = choose_adapter(&infos, choice)?;
        let request = adapters[chosen].request_device(&device_descriptor(&adapters[chosen]));
        let (device, queue) = pollster::block_on(request)
            .map_err(|source| GpuError::Refused { adapter: infos[chosen].name.clone(), source })?;
        Ok(Self::from_parts(device, queue))
    }

    /// Takes over the device that a window opened. Failures on it no longer panic: [`Gpu::check`] reports them.
    pub fn from_parts(device: wgpu::Device, queue: wgpu::Queue) -> Self {
        let failure = Arc::new(Mutex::new(None));
        let uncaptured = Arc::clone(&failure);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| keep_first(&uncaptured, error.to_string())));
        let lost = Arc::clone(&failure);
        device.set_device_lost_callback(move |reason, message| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                keep_first(&lost, format!("it was lost ({message})"));
            }
        });
        Self { device, queue, failure }
    }

    /// Reports the first failure since the last call.
    ///
    /// # Errors
    /// If the device was lost, ran out of memory, or was used wrongly.
    pub fn check(&self) -> Result<(), GpuError> {
        match self.failure.lock().unwrap_or_else(PoisonError::into_inner).take() {
            Some(message) => Err(GpuError::Failed(message)),
            None => Ok(()),
        }
    }

    /// The adapter's name and how it is reached.
    pub fn adapter_name(&self) -> String {
        let info = self.device.adapter_info();
        format!("{} ({})", info.name, info.backend)
    }

    /// Whether the adapter draws on the processor, and so at the expense of everything else.
    pub fn is_software(&self) -> bool {
        self.device.adapter_info().device_type == wgpu::DeviceType::Cpu
    }
}

fn keep_first(failure: &Mutex<Option<String>>, message: String) {
    failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(message);
}

/// What a device for a [`super::Viewport`] must offer: what every adapter has, and textures and buffers as large as
/// this one allows.
pub fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    let offered = adapter.limits();
    wgpu::DeviceDescriptor {
        label: Some("lightwell"),
        required_limits: wgpu::Limits {
            max_texture_dimension_2d: offered.max_texture_dimension_2d,
            max_buffer_size: offered.max_buffer_size,
            max_storage_buffer_binding_size: offered.max_storage_buffer_binding_size,
            ..wgpu::Limits::default()
        },
        ..wgpu::DeviceDescriptor::default()
    }
}

/// The index of the adapter to use.
///
/// # Errors
/// If there is none, or none that matches.
pub fn choose_adapter(infos: &[wgpu::AdapterInfo], choice: &AdapterChoice) -> Result<usize, GpuError> {
    if infos.is_empty() {
        return Err(GpuError::NoAdapter);
    }
    let best_of = |matches: &dyn Fn(&wgpu::AdapterInfo) -> bool| {
        let candidates = infos.iter().enumerate().filter(|(_, info)| matches(info));
        candidates.min_by_key(|(_, info)| rank(info.device_type)).map(|(index, _)| index)
    };
    let chosen = match choice {
        AdapterChoice::System => best_of(&|_| true),
        AdapterChoice::Software => best_of(&|info| info.device_type == wgpu::DeviceType::Cpu),
        AdapterChoice::Named(name) => {
            let name = name.to_lowercase();
            infos.iter().position(|info| info.name.to_lowercase().contains(&name))
        }
    };
    chosen.ok_or_else(|| {
        let names: Vec<_> = infos.iter().map(|info| format!("`{}`", info.name)).collect();
        GpuError::NoSuchAdapter { wanted: choice.clone(), known: names.join(", ") }
    })
}

/// A window's way to [`choose_adapter`], among those that can show pictures on its surface.
pub fn adapter_selector(
    choice: AdapterChoice,
) -> impl Fn(&[wgpu::Adapter], Option<&wgpu::Surface<'_>>) -> Result<wgpu::Adapter, String> {
    move |adapters, surface| {
        let usable = |adapter: &&wgpu::Adapter| surface.is_none_or(|surface| adapter.is_surface_supported(surface));
        let usable: Vec<_> = adapters.iter().filter(usable).collect();
        let infos: Vec<_> = usable.iter().map(|adapter| adapter.get_info()).collect();
        let chosen = choose_adapter(&infos, &choice).map_err(|error| error.to_string())?;
        Ok(usable[chosen].clone())
    }
}

/// The lower, the faster it is likely to be.
fn rank(device_type: wgpu::DeviceType) -> u8 {
    match device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn info(name: &str, device_type: wgpu::DeviceType) -> wgpu::AdapterInfo {
        wgpu::AdapterInfo {
            name: name.to_owned(),
            vendor: 0,
            device: 0,
            device_type,
            device_pci_bus_id: String::new(),
            driver: String::new(),
            driver_info: String::new(),
            backend: wgpu::Backend::Vulkan,
            subgroup_min_size: 4,
            subgroup_max_size: 128,
            transient_saves_memory: None,
            limit_bucket: None,
        }
    }

    fn machine() -> Vec<wgpu::AdapterInfo> {
        vec![
            info("llvmpipe (LLVM 15)", wgpu::DeviceType::Cpu),
            info("Integrated Graphics 620", wgpu::DeviceType::IntegratedGpu),
            info("Discrete 4000", wgpu::DeviceType::DiscreteGpu),
        ]
    }

    fn chosen(text: &str) -> Result<usize, GpuError> {
        let Ok(choice) = text.parse::<AdapterChoice>();
        choose_adapter(&machine(), &choice)
    }

    #[test]
    fn the_system_prefers_the_adapter_that_is_likely_to_be_fastest() {
        assert_eq!(chosen("system").expect("an adapter"), 2);
        let without_discrete = choose_adapter(&machine()[..2], &AdapterChoice::System);
        assert_eq!(without_discrete.expect("an adapter"), 1);
    }

    #[test]
    fn adapters_are_found_by_kind_or_by_part_of_their_name() {
        assert_eq!(chosen("software").expect("an adapter"), 0);
        assert_eq!(chosen("graphics 6").expect("an adapter"), 1);
        assert_eq!(chosen("LLVMPIPE").expect("an adapter"), 0);
    }

    #[test]
    fn a_name_that_matches_nothing_is_answered_with_those_that_exist() {
        let message = chosen("voodoo").expect_err("no such adapter").to_string();
        for part in ["voodoo", "llvmpipe (LLVM 15)", "Integrated Graphics 620", "Discrete 4000"] {
            assert!(message.contains(part), "{message}");
        }
        let message = choose_adapter(&machine()[1..], &AdapterChoice::Software).expect_err("none").to_string();
        assert!(message.contains("software"), "{message}");
    }

    #[test]
    fn a_machine_without_adapters_is_told_what_to_install() {
        let message = choose_adapter(&[], &AdapterChoice::System).expect_err("none").to_string();
        assert!(message.contains("mesa-vulkan-drivers") && message.contains("libvulkan1"), "{message}");
    }
}
