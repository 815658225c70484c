//! Arguments of `live`.

use super::basic::{BasicArgs, InstanceArgs};
use super::operator::OperatorArgs;
use super::path::PathArgs;
use super::program::{ProgramArgs, program_file};
use crate::program_file::ProgramFile;
use clap::{Args, Subcommand, ValueEnum};
use glidepath_live::Role;
use std::net::SocketAddr;
use std::path::PathBuf;

/// Arguments of `live`.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true)]
pub struct LiveArgs {
    /// Something else than serving the page.
    #[command(subcommand)]
    pub action: Option<LiveAction>,
    /// A program to show until the machine executes another one. The running program is shown even
    /// without it
    #[arg(value_name = "PROGRAM", value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub file: Option<ProgramFile>,
    /// The port on 127.0.0.1; 0 selects any free one
    #[arg(long, default_value_t = 8420)]
    pub port: u16,
    /// What the page may do: only look; hold and abort; or operate the machine
    #[arg(long, value_name = "ROLE", value_enum, default_value_t = May::Look)]
    pub may: May,
    /// An address of this host, with a port, where paired tablets and phones open the page over TLS, to look and to
    /// hold; without it there is none
    #[arg(long, value_name = "ADDRESS:PORT", value_parser = device_address)]
    pub devices: Option<SocketAddr>,
    /// List this machine on the pages of the other machines of this user on this host, with a way to this page: to what
    /// each of them may itself
    #[arg(long)]
    pub listed: bool,
    /// A file that is written to open the page in a browser, and that says so where the page has ended. Whoever can read it
    /// may do what the page may: this user, and in a folder with the setgid bit its group
    #[arg(long, value_name = "FILE", value_hint = clap::ValueHint::FilePath)]
    pub shortcut: Option<PathBuf>,
    /// Folder of the programs that the page lists, runs and stores
    #[arg(long, value_name = "FOLDER", value_hint = clap::ValueHint::DirPath)]
    pub programs: Option<PathBuf>,
    /// How the program is read.
    #[command(flatten)]
    pub program: ProgramArgs,
    /// How the path is followed.
    #[command(flatten)]
    pub path: PathArgs,
    /// The interpolator that is meant.
    #[command(flatten)]
    pub operator: OperatorArgs,
}

impl LiveArgs {
    /// Configuration and form of the report.
    #[must_use]
    pub const fn basic(&self) -> &BasicArgs {
        match &self.action {
            Some(LiveAction::Devices(args)) => args.basic(),
            None => &self.operator.basic,
        }
    }

    /// The instance that is meant.
    #[must_use]
    pub const fn instance(&self) -> &InstanceArgs {
        match &self.action {
            Some(LiveAction::Devices(args)) => args.instance(),
            None => &self.operator.instance,
        }
    }
}

/// What else `live` does.
#[derive(Debug, Subcommand)]
pub enum LiveAction {
    /// List the paired tablets and phones, or revoke one; the page need not run
    #[command(after_help = "Examples: glidepath live devices --config mill.toml · \
                            glidepath live devices revoke 'Tablet' --config mill.toml")]
    Devices(DevicesArgs),
}

/// Arguments of `live devices`.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true)]
pub struct DevicesArgs {
    /// Something else than listing.
    #[command(subcommand)]
    pub action: Option<DevicesAction>,
    /// The machine that is meant.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
}

impl DevicesArgs {
    /// Configuration and form of the report.
    #[must_use]
    pub const fn basic(&self) -> &BasicArgs {
        match &self.action {
            Some(DevicesAction::Revoke(args)) => &args.basic,
            None => &self.basic,
        }
    }

    /// The machine that is meant.
    #[must_use]
    pub const fn instance(&self) -> &InstanceArgs {
        match &self.action {
            Some(DevicesAction::Revoke(args)) => &args.instance,
            None => &self.instance,
        }
    }
}

/// What is done with a device.
#[derive(Debug, Subcommand)]
pub enum DevicesAction {
    /// End the pairing of a device: what it has open ends within a second or two
    #[command(after_help = "Example: glidepath live devices revoke 'Tablet' --config mill.toml")]
    Revoke(RevokeArgs),
}

/// Arguments of `live devices revoke`.
#[derive(Debug, Args)]
pub struct RevokeArgs {
    /// The device, as it is listed
    #[arg(value_name = "NAME")]
    pub name: String,
    /// The machine that is meant.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
}

/// One address, which devices open and the certificate is for.
fn device_address(text: &str) -> Result<SocketAddr, &'static str> {
    const ONE: &str = "name one address of this host and a port, as 192.168.1.20:8443 or [fd00::20]:8443: devices \
                       open it, and the certificate is for it";
    let address: SocketAddr = text.parse().map_err(|_| ONE)?;
    let ip = address.ip();
    if ip.is_unspecified() || ip.is_multicast() {
        return Err(ONE);
    }
    Ok(address)
}

/// What a page may.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum May {
    /// See the machine
    Look,
    /// See it and stop it: hold and abort
    Hold,
    /// Do all that an operator does
    Operate,
}

impl May {
    /// The role of the page.
    #[must_use]
    pub const fn role(self) -> Role {
        match self {
            Self::Look => Role::Look,
            Self::Hold => Role::Hold,
            Self::Operate => Role::Operate,
        }
    }
}
